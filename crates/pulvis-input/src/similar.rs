//! "Did you mean …?": the known name that a misspelled one stands closest to.

/// The candidate that `word` is most likely a misspelling of, if any is close enough.
///
/// A slip, not a guess: one edit in three letters; upper case, `-` and `_` do not count.
pub(crate) fn similar<'c>(word: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    let wanted = plain(word);
    candidates
        .into_iter()
        .map(|candidate| (strsim::damerau_levenshtein(&wanted, &plain(candidate)), candidate))
        .filter(|(edits, candidate)| {
            let longer = wanted.chars().count().max(candidate.chars().count());
            *edits <= longer / 3
        })
        .min_by_key(|(edits, _)| *edits)
        .map(|(_, candidate)| candidate)
}

fn plain(word: &str) -> String {
    word.to_lowercase().replace(['-', '_'], "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swapped_letter_finds_its_word_and_a_stranger_finds_none() {
        assert_eq!(similar("fricton", ["density", "friction"]), Some("friction"));
        assert_eq!(similar("Phi-F", ["k1", "phi_f"]), Some("phi_f"));
        assert_eq!(similar("temperature", ["density", "friction"]), None);
    }

    #[test]
    fn a_short_symbol_is_no_misspelling_of_another() {
        assert_eq!(similar("kp", ["k1", "kc"]), None);
        assert_eq!(similar("k_1", ["k1", "kc"]), Some("k1"));
    }
}
