"""Fuzzing: no input ends in a traceback, a hang, a wrong exit code, a lying number.

NETDESIGN_FUZZ_SEED=7 NETDESIGN_FUZZ_EXAMPLES=20000 python -m pytest -m fuzz -s ...
"""

import os
import time

import pytest
from hypothesis import HealthCheck, Phase, given, seed, settings

from tests.fuzz.targets import TARGETS, Target, time_limit

IN_THE_SUITE = 200
EXAMPLES = int(os.environ.get("NETDESIGN_FUZZ_EXAMPLES", "100000"))
SEED = int(os.environ.get("NETDESIGN_FUZZ_SEED", "20261121"))
_COMMON = {
    "suppress_health_check": list(HealthCheck),
    "phases": (Phase.generate, Phase.shrink),
}


def run(target: Target, count: int, **chosen: object) -> int:
    """Try ``count`` inputs; how many were tried in truth."""
    tried = 0

    @settings(max_examples=count, **_COMMON, **chosen)
    @given(target.drawn)
    def try_all(drawn):
        nonlocal tried
        tried += 1
        with time_limit():
            target.try_one(drawn)

    if not chosen:
        try_all = seed(SEED)(try_all)
    try_all()
    return tried


@pytest.fixture(params=TARGETS, ids=[target.name for target in TARGETS])
def target(request):
    return request.param


@pytest.mark.long
def test_a_few_inputs_end_soundly(target):
    count = max(10, round(IN_THE_SUITE * target.share))
    assert run(target, count, derandomize=True) >= 0.5 * count


@pytest.mark.fuzz
def test_very_many_inputs_end_soundly(target, capsys):
    start = time.perf_counter()
    count = round(EXAMPLES * target.share)
    tried = run(target, count)
    elapsed = time.perf_counter() - start
    with capsys.disabled():
        print(f"\n{target.name}: {tried} of {count} tried, {elapsed:.0f} s")  # noqa: T201
    assert tried >= 0.9 * count
