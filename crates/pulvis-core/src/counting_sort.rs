//! Counting sort: sorts by small whole numbers in linear time.

/// Sorts the indices of `keys` by key, in a stable way. All keys are below `count`. Afterwards `order` holds the sorted
/// indices, and those with key k are `order[starts[k]..starts[k + 1]]`.
pub(crate) fn counting_sort(keys: &[u32], count: usize, starts: &mut Vec<u32>, order: &mut Vec<u32>) {
    // 1. Count key k in starts[k + 2], so that the sums of step 2 put the start of key k into starts[k + 1].
    // 2. In step 3, starts[k + 1] is the next free slot of key k. When all its indices are placed, it has become the
    //    start of key k + 1, which is what the caller wants. So no second array is needed.
    starts.clear();
    starts.resize(count + 2, 0);
    for &key in keys {
        starts[key as usize + 2] += 1;
    }
    for index in 2..starts.len() {
        starts[index] += starts[index - 1];
    }
    order.resize(keys.len(), 0);
    for (index, &key) in keys.iter().enumerate() {
        let next = &mut starts[key as usize + 1];
        order[*next as usize] = index as u32;
        *next += 1;
    }
    starts.pop();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_keys_stay_in_their_order() {
        let (mut starts, mut order) = (vec![9; 3], vec![9; 20]);
        counting_sort(&[2, 0, 2, 3, 0], 5, &mut starts, &mut order);
        assert_eq!(order, [1, 4, 0, 2, 3]);
        assert_eq!(starts, [0, 2, 2, 4, 5, 5]);
        counting_sort(&[], 1, &mut starts, &mut order);
        assert_eq!((starts, order), (vec![0, 0], vec![]));
    }
}
