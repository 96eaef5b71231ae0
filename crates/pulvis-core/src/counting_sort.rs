//! Sorting by small whole numbers.

/// Sorts indices by their keys, which are below `count`: `order` tells which index comes where, those of equal keys in
/// ascending order, and `starts` where each key begins, and the end.
pub(crate) fn counting_sort(keys: &[u32], count: usize, starts: &mut Vec<u32>, order: &mut Vec<u32>) {
    // Counts are kept two indices later, so that the next free indices, which end up as the indices where
    // the next keys begin, can be kept one index later: no second array is needed.
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
