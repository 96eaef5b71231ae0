//! Texts with lowered and raised letters: `k_{p}` is a k with a small p below it, `k^{a}` one with a small a above it.

/// Height of lowered and raised letters over that of the others.
const SMALLER: f64 = 0.72;

/// How far their baseline lies below \[em\].
const LOWERED: f64 = 0.19;

/// How far the baseline of raised ones lies above \[em\].
const RAISED: f64 = 0.34;

/// A piece of a text that is set in one size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run<'t> {
    pub(crate) text: &'t str,
    /// Size over that of the whole text.
    pub(crate) size: f64,
    /// Distance of its baseline below that of the whole text \[em of the whole\].
    pub(crate) below: f64,
}

/// The pieces of a text. A brace that is never closed is a letter.
pub(crate) fn runs(text: &str) -> Vec<Run<'_>> {
    let plain = |text| Run { text, size: 1.0, below: 0.0 };
    let mut runs = Vec::new();
    let mut rest = text;
    while let Some((before, inside, after, below)) = split(rest) {
        runs.extend([plain(before), Run { text: inside, size: SMALLER, below }]);
        rest = after;
    }
    runs.push(plain(rest));
    runs.retain(|run| !run.text.is_empty());
    runs
}

fn split(text: &str) -> Option<(&str, &str, &str, f64)> {
    let marks = [("_{", LOWERED), ("^{", -RAISED)];
    let found = marks.into_iter().filter_map(|(mark, below)| Some((text.find(mark)?, below)));
    let (start, below) = found.min_by_key(|(start, _)| *start)?;
    let (before, rest) = text.split_at(start);
    let (inside, after) = rest.get(2..)?.split_once('}')?;
    Some((before, inside, after, below))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn braces_after_a_bar_lower_what_is_in_them() {
        let texts = |text| runs(text).iter().map(|run| (run.text, run.below > 0.0)).collect::<Vec<_>>();
        let expected = vec![("δ/δ", false), ("p", true), (" [1]", false)];
        assert_eq!(texts("δ/δ_{p} [1]"), expected);
        assert_eq!(texts("overlap_max"), vec![("overlap_max", false)]);
        assert_eq!(texts("a_{b"), vec![("a_{b", false)]);
        let raised = runs("k_{c}^{a}");
        assert!(raised.len() == 3 && raised[1].below > 0.0 && raised[2].below < 0.0, "{raised:?}");
        assert!(runs("").is_empty());
    }
}
