"""A contact and a scenario that many tests use."""

from __future__ import annotations

from typing import Any

import pytest

import pulvis


@pytest.fixture
def luding() -> pulvis.Law:
    """The contact of the figures of Singh, Magnanimo & Luding."""
    return pulvis.law("luding", k1=100.0, kp=500.0, kc=100.0, phi_f=0.05)


@pytest.fixture
def gas() -> dict[str, Any]:
    """Spheres that fly about and meet, in two stages."""
    return {
        "seed": 3,
        "materials": {"glass": {"density": 2500}},
        "contacts": {
            "glass-glass": {
                "normal": {"law": "linear", "k": 1000, "gamma_0": 1e-3},
                "sliding": {"law": "spring-slider", "kt": 300, "mu": 0.3},
            }
        },
        "domain": {"lower": [0, 0, 0], "upper": [12e-3, 12e-3, 12e-3], "periodic": ["x", "y", "z"]},
        "particles": [
            {
                "material": "glass",
                "radius": {"distribution": "fixed", "value": 0.95e-3},
                "arrangement": {"kind": "lattice", "lower": [0, 0, 0], "counts": [6, 6, 6], "spacing": 2e-3},
                "velocity": {"standard_deviation": 0.5},
            }
        ],
        "stages": [
            {"name": "mix", "until": {"time": 1e-3}},
            {"name": "fall", "until": {"time": 1e-3}, "set": {"gravity": [0, 0, -9.81]}},
        ],
    }
