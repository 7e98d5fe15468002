"""Solves many cases of many net rows; says what memory and file handles come to."""

import json
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.outcome import Outcome
from netdesign.solving.runner import Runner
from netdesign.solving.store import CaseStore
from netdesign.solving.workers import Job, OwnProcess, ProcessPool
from tests.scenes import ICE, build_scene

COARSE = SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2])
STEPS = 20
CASES_OF_A_ROW = 20
KIB = 1024.0


def build_job(number):
    """Case of a row; ranges as of the example."""
    draw = np.random.default_rng([number])
    row = np.random.default_rng([number // CASES_OF_A_ROW, 1])
    scene = build_scene(
        slope_deg=38.0,
        thickness_m=3.0,
        length_m=float(row.uniform(6.0, 30.0)),
        relative_density=draw.uniform(270.0, 400.0) / ICE,
        inclination_deg=draw.uniform(25.0, 35.0),
        stiffness_kN_per_m=1e4,
        slack=0.05,
        friction_deg=draw.uniform(15.0, 45.0),
    )
    return Job(scene=scene, settings=COARSE)


def list_processes():
    """This process and its workers."""
    own = os.getpid()
    children = Path(f"/proc/{own}/task/{own}/children").read_text().split()
    return [own, *map(int, children)]


def measure():
    """Resident memory [MiB] and open files of this process and its workers."""
    memory = files = 0
    for process in list_processes():
        place = Path(f"/proc/{process}")
        lines = (place / "status").read_text().splitlines()
        (resident,) = (line.split()[1] for line in lines if line.startswith("VmRSS"))
        memory += int(resident) / KIB
        files += len(list((place / "fd").iterdir()))
    return {"memory_MiB": round(memory, 1), "files": files}


def soak(cases, processes, place):
    """Measurements, first after one twentieth of the cases."""
    workers = OwnProcess() if processes == 1 else ProcessPool(processes, worth=1)
    begin, found = time.monotonic(), []
    with CaseStore(place / "cases.sqlite", sys.stderr.write) as store:
        runner = Runner(workers=workers, store=store)
        for step in range(STEPS):
            numbers = range(step * cases // STEPS, (step + 1) * cases // STEPS)
            ends = runner.solve([build_job(number) for number in numbers])
            failed = sum(end.outcome is not Outcome.CONVERGED for end in ends)
            found.append(
                {"cases": numbers.stop, "failed": failed}
                | measure()
                | {"elapsed_s": round(time.monotonic() - begin, 1)}
            )
            sys.stdout.write(json.dumps(found[-1]) + "\n")
            sys.stdout.flush()
    workers.close()
    return found


def main():
    cases, processes = (int(one) for one in sys.argv[1:])
    with tempfile.TemporaryDirectory() as place:
        soak(cases, processes, Path(place))


if __name__ == "__main__":
    main()
