"""Many runs of one scenario."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pulvis

OVER = {"contacts.glass-glass.normal.k": [500.0, 2000.0], "seed": [1, 2]}


def test_a_study_has_the_results_of_its_runs_alone(gas: dict[str, Any], tmp_path: Path) -> None:
    study = pulvis.study(gas, OVER, tmp_path / "study", processes=2)
    assert [case.settings["seed"] for case in study] == [1, 2, 1, 2] and not study.failed
    for case in study:
        alone = pulvis.Simulation(gas, set=case.settings)
        alone.run()
        for name, value in alone.measure().items():
            assert np.array_equal(case.values[name], value, equal_nan=True), name
    assert np.array_equal(study[3].run.timeseries.kinetic[-1], study[3].values["kinetic"])


def test_runs_that_are_done_are_not_repeated_and_an_interrupted_one_goes_on(
    gas: dict[str, Any], tmp_path: Path
) -> None:
    with ThreadPoolExecutor(2) as executor:
        first = pulvis.study(gas, OVER, tmp_path / "study", executor=executor)
        files = [case.folder / "run/timeseries.csv" for case in first]
        written = [file.stat().st_mtime_ns for file in files]
        # As if the second case had been stopped before it was recorded.
        (first[1].folder / "case.json").unlink()
        again = pulvis.study(gas, OVER, tmp_path / "study", executor=executor)
    assert [case.values["kinetic"] for case in again] == [case.values["kinetic"] for case in first]
    now = [file.stat().st_mtime_ns for file in files]
    assert [old == new for old, new in zip(written, now)] == [True, False, True, True]


def test_a_run_that_fails_is_recorded_and_the_others_go_on(gas: dict[str, Any], tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    settings = [{"seed": 1}, {"contacts.glass-glass.normal.k": -1}, {"contacts.glass-glass.normal.q": 1}]
    with ThreadPoolExecutor(1) as executor:
        study = pulvis.study(
            gas, settings, tmp_path / "study", executor=executor, results=lambda run: {"rows": len(run.timeseries.time)}
        )
    assert len(study.failed) == 2 and study[0].error is None
    assert study[1].error is not None and "-1 N/m is out of range" in study[1].error
    frame = study.to_dataframe()
    assert isinstance(frame, pandas.DataFrame) and frame["rows"].notna().tolist() == [True, False, False]


def test_a_folder_of_another_study_is_left_alone(gas: dict[str, Any], tmp_path: Path) -> None:
    with ThreadPoolExecutor(1) as executor:
        pulvis.study(gas, {"seed": [1]}, tmp_path / "study", executor=executor)
        before = json.loads((tmp_path / "study/study.json").read_text())
        with pytest.raises(pulvis.InputError, match="of other values"):
            pulvis.study(gas, {"seed": [2]}, tmp_path / "study", executor=executor)
        (tmp_path / "other").mkdir()
        (tmp_path / "other/mine.txt").write_text("mine")
        with pytest.raises(pulvis.InputError, match="holds no study"):
            pulvis.study(gas, {"seed": [2]}, tmp_path / "other", executor=executor)
        with pytest.raises(pulvis.InputError, match="nothing to study"):
            pulvis.study(gas, {"seed": []}, tmp_path / "new", executor=executor)
    assert json.loads((tmp_path / "study/study.json").read_text()) == before


def test_a_cluster_of_dask_gives_the_values_of_this_process(gas: dict[str, Any], tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    over = {"seed": [1, 2], "contacts.glass-glass.normal.k": [1000, -5]}
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
        there = pulvis.study(gas, over, tmp_path / "there", executor=client.get_executor())
    with ThreadPoolExecutor(2) as executor:
        here = pulvis.study(gas, over, tmp_path / "here", executor=executor)
    assert [case.values for case in there] == [case.values for case in here]
    assert len(there.failed) == 2 and all("k: -5 N/m" in (case.error or "") for case in there.failed)


#: A script as users start it: the runs of a study go to the ranks.
ON_RANKS = """
import json, sys
from pathlib import Path
import pulvis

if __name__ == "__main__":
    from mpi4py.futures import MPIPoolExecutor

    task = json.loads(Path(sys.argv[1]).read_text())
    with MPIPoolExecutor() as executor:
        study = pulvis.study(task["scenario"], task["over"], sys.argv[2], executor=executor)
    print(json.dumps([[case.values, case.error] for case in study]))
"""


def test_ranks_of_mpi_give_the_values_of_this_process(gas: dict[str, Any], tmp_path: Path) -> None:
    pytest.importorskip("mpi4py")
    launcher = shutil.which("mpiexec")
    if launcher is None:
        pytest.skip("there is no mpiexec")
    over = {"seed": [1, 2], "contacts.glass-glass.normal.k": [1000, -5]}
    (tmp_path / "script.py").write_text(ON_RANKS)
    (tmp_path / "task.json").write_text(json.dumps({"scenario": gas, "over": over}))
    # Open MPI wants to be told that there are fewer processors than ranks, and that whoever tests may be root.
    variables = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    variables |= {"OMPI_MCA_rmaps_base_oversubscribe": "1", "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}
    command = [launcher, "-n", "3", sys.executable, "-m", "mpi4py.futures", "script.py", "task.json", "there"]
    ran = subprocess.run(
        command, capture_output=True, text=True, check=False, cwd=tmp_path, env={**os.environ, **variables}, timeout=120
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    there = json.loads(ran.stdout)
    with ThreadPoolExecutor(2) as executor:
        here = pulvis.study(gas, over, tmp_path / "here", executor=executor)
    assert json.dumps([[case.values, case.error] for case in here]) == json.dumps(there)
    assert sum(error is not None for _, error in there) == 2
