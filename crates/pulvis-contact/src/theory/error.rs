//! What a closed form refuses.

/// A parameter set for which the closed forms have no meaning.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TheoryError {
    /// A quantity that must be finite and positive is not.
    #[error("{name} must be positive and finite, it is {value}")]
    NotPositive {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity that must be finite and not negative is not.
    #[error("{name} must be finite and not negative, it is {value}")]
    Negative {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// Unloading would be softer than loading: the contact would create energy.
    #[error("the limit stiffness kp = {kp} N/m must not be below the loading stiffness k1 = {k1} N/m")]
    SofterUnloading {
        /// Loading stiffness [N/m].
        k1: f64,
        /// Limit stiffness [N/m].
        kp: f64,
    },
    /// An adhesive force was given, but no rule for what it does on approach and separation.
    #[error("an adhesive force f_a = {adhesion_force} N needs a non-contact rule (reversible or jump-in)")]
    AdhesionWithoutRule {
        /// Adhesive force \[N\].
        adhesion_force: f64,
    },
    /// The formula belongs to the linear interpolation of the unloading stiffness.
    #[error("the tuning of appendix A holds for the linear interpolation of k2 only")]
    NotLinearInterpolation,
    /// A coefficient of restitution outside (0, 1].
    #[error("a coefficient of restitution lies in (0, 1], it is {value}")]
    RestitutionOutOfRange {
        /// The coefficient given.
        value: f64,
    },
}

/// Returns `value` if it is finite and positive.
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, TheoryError> {
    if value.is_finite() && value > 0.0 { Ok(value) } else { Err(TheoryError::NotPositive { name, value }) }
}

/// Returns `value` if it is finite and not negative.
pub(super) fn not_negative(name: &'static str, value: f64) -> Result<f64, TheoryError> {
    if value.is_finite() && value >= 0.0 { Ok(value) } else { Err(TheoryError::Negative { name, value }) }
}
