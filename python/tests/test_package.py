"""The package itself: its stubs, its types, its examples."""

from __future__ import annotations

import ast
import doctest
import importlib
import importlib.metadata
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest

import pulvis
from pulvis import _native

PACKAGE = Path(pulvis.__file__).parent


def names_of(body: list[ast.stmt]) -> set[str]:
    names: set[str] = set()
    for statement in body:
        if isinstance(statement, (ast.FunctionDef, ast.ClassDef)):
            names.add(statement.name)
        elif isinstance(statement, ast.AnnAssign) and isinstance(statement.target, ast.Name):
            names.add(statement.target.id)
    return names


def public(thing: object) -> set[str]:
    return {name for name in dir(thing) if not name.startswith("_")}


def test_the_stubs_name_what_the_compiled_part_has() -> None:
    stub = ast.parse((PACKAGE / "_native.pyi").read_text())
    assert names_of(stub.body) - {"__version__"} == public(_native)
    [session] = [s for s in stub.body if isinstance(s, ast.ClassDef) and s.name == "Session"]
    assert names_of(session.body) - {"__init__"} == public(_native.Session)


def test_the_stubs_take_the_arguments_that_the_compiled_part_takes() -> None:
    stub = ast.parse((PACKAGE / "_native.pyi").read_text())
    functions = [s for s in stub.body if isinstance(s, ast.FunctionDef)]
    assert len(functions) == 5
    for function in functions:
        signature = getattr(_native, function.name).__text_signature__
        given = [argument.strip().split("=")[0] for argument in signature.strip("()").split(",") if argument.strip()]
        assert given == [argument.arg for argument in function.args.args], function.name


def test_the_stubs_of_the_session_take_the_arguments_that_its_methods_take() -> None:
    stub = ast.parse((PACKAGE / "_native.pyi").read_text())
    [session] = [s for s in stub.body if isinstance(s, ast.ClassDef) and s.name == "Session"]
    compared = 0
    for method in [s for s in session.body if isinstance(s, ast.FunctionDef)]:
        decorators = {decorator.id for decorator in method.decorator_list if isinstance(decorator, ast.Name)}
        if "property" in decorators or method.name == "__init__":
            continue
        signature = getattr(_native.Session, method.name).__text_signature__
        given = [argument.strip().split("=")[0].lstrip("$") for argument in signature.strip("()").split(",")]
        given = [argument for argument in given if argument not in ("", "/")]
        assert given == [argument.arg for argument in method.args.args], method.name
        compared += 1
    assert compared > 15


def test_what_is_public_is_typed_and_listed() -> None:
    assert (PACKAGE / "py.typed").is_file()
    assert set(pulvis.__all__) <= set(dir(pulvis))
    for name in pulvis.__all__:
        thing = getattr(pulvis, name)
        if isinstance(thing, type):
            for part in public(thing) - public(Exception):
                documented = (getattr(thing, part).__doc__ or "").strip()
                assert documented, f"{name}.{part} has no documentation"


def test_types_hold() -> None:
    pytest.importorskip("mypy")
    config = Path(__file__).parents[1] / "pyproject.toml"
    command = [sys.executable, "-m", "mypy", "--config-file", str(config)]
    checked = subprocess.run(command, capture_output=True, text=True, check=False, cwd=config.parent)
    assert checked.returncode == 0, checked.stdout + checked.stderr


@pytest.mark.parametrize("name", [module.name for module in pkgutil.iter_modules([str(PACKAGE)])])
def test_examples_in_docstrings_hold(name: str) -> None:
    if name == "_native":
        pytest.skip("has none")
    failures, _ = doctest.testmod(importlib.import_module(f"pulvis.{name}"))
    assert failures == 0


def test_everything_public_is_documented() -> None:
    for name in pulvis.__all__:
        assert name == "__version__" or (getattr(pulvis, name).__doc__ or "").strip(), name


def test_the_versions_are_one() -> None:
    assert _native.__version__ == pulvis.__version__
    try:
        assert importlib.metadata.version("pulvis") == pulvis.__version__
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("not installed, but found on the path")


def test_the_package_is_there_at_once() -> None:
    command = [sys.executable, "-X", "importtime", "-c", "import numpy; import pulvis"]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    [line] = [line for line in told.splitlines() if line.rstrip().endswith("| pulvis")]
    # Beside numpy; the promise is 0.1 s, a busy machine takes longer.
    assert int(line.split("|")[1]) < 500_000


def test_the_code_of_the_book_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    book = Path(__file__).parents[2] / "docs/book/src/python.md"
    if not book.is_file():
        pytest.skip("the book is not here")
    monkeypatch.chdir(tmp_path)
    blocks = [part.split("```")[0] for part in book.read_text(encoding="utf-8").split("```python\n")[1:]]
    assert len(blocks) >= 7
    names: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, str(book), "exec"), names)
