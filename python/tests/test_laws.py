"""The catalogue, and what is refused of a law."""

from __future__ import annotations

import pydoc

import numpy as np
import pytest

import pulvis

tomllib = pytest.importorskip("tomllib")


def test_every_example_of_the_catalogue_is_a_law() -> None:
    entries = pulvis.laws()
    assert len(entries) > 40
    for entry in entries:
        given = tomllib.loads(entry.example)
        assert given.pop("law", entry.name) == entry.name
        made = pulvis.law(entry.name, role=entry.role, **given)
        assert made.name == entry.name and made.role == entry.role


def test_help_tells_parameters_with_units_equations_and_source() -> None:
    [entry] = [entry for entry in pulvis.laws("normal") if entry.name == "luding"]
    text = pydoc.render_doc(entry, renderer=pydoc.plaintext)
    for words in ("k1 : N/m, > 0; required", "f   = k2 (δ − δ_0)", "arXiv:1503.03720", "Parameters", "References"):
        assert words in text, words


@pytest.mark.parametrize(
    ("parameters", "key", "words"),
    [
        ({"k1": -1, "kp": 500, "kc": 1, "phi_f": 0.05}, "k1", "-1 N/m is out of range"),
        ({"k1": "1 N", "kp": 500, "kc": 1, "phi_f": 0.05}, "k1", '"1 N" is a force [N], expected a stiffness'),
        ({"k1": 100, "kp": 50, "kc": 1, "phi_f": 0.05}, "kp", "expected kp >= k1 = 100 N/m"),
        ({"k1": 100, "kp": 500, "phi_f": 0.05}, "", "missing `kc`"),
        ({"k_1": 100, "k1": 100, "kp": 500, "kc": 1, "phi_f": 0.05}, "k_1", "unknown key"),
        ({"k1": float("nan"), "kp": 500, "kc": 1, "phi_f": 0.05}, "k1", "not a number"),
    ],
)
def test_a_parameter_that_is_wrong_is_named(parameters: dict[str, object], key: str, words: str) -> None:
    with pytest.raises(pulvis.InputError) as refused:
        pulvis.law("luding", **parameters)
    assert isinstance(refused.value, ValueError)
    assert words in str(refused.value)
    assert refused.value.key == key


def test_units_and_si_numbers_make_the_same_law() -> None:
    path = {"radius": 1e-3, "density": 2000, "overlap": [0, 2e-5, 0]}
    one = pulvis.law("luding", k1="0.1 kN/m", kp="500 N/m", kc="100 N/m", phi_f=0.05).probe(**path)
    other = pulvis.law("luding", k1=100, kp=500.0, kc=np.float64(100), phi_f="0.05").probe(**path)
    assert np.array_equal(one.force, other.force)


def test_laws_that_do_not_exist_are_told_with_those_that_do() -> None:
    with pytest.raises(pulvis.InputError, match="did you mean 'luding'"):
        pulvis.law("ludding", k1=1)
    with pytest.raises(pulvis.InputError, match="there are normal, noncontact"):
        pulvis.laws("tangential")


def test_a_contact_has_one_law_of_each_role(luding: pulvis.Law) -> None:
    slider = pulvis.law("spring-slider", kt=20, mu=0.3)
    assert list(pulvis.contact(luding, slider).laws) == ["normal", "sliding"]
    with pytest.raises(pulvis.InputError, match="two laws of the role 'normal'"):
        pulvis.contact(luding, luding)
