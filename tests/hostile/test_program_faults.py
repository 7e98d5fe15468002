"""A fault of the program, wherever it falls: told, exit code 5, the other rows kept."""

import json
import math
import random
import re
from functools import lru_cache, partial

import pytest

from netdesign.addons.history.settings import TransientSettings
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope import panel_forces
from netdesign.envelope import rows as envelope_rows
from netdesign.envelope.ranges import place_scene
from netdesign.outcome import SENTENCE, ModelError
from netdesign.site.reader import read_site
from netdesign.solving import solve as solve_module
from netdesign.solving import workers as workers_module
from netdesign.solving.solve import solve_scene
from netdesign.solving.workers import ProcessPool
from tests.make import write_rows
from tests.small_scene import SMALL_SCENE

QUICK = ("--accuracy", "0.1", "--jobs", "1", "--quiet")
KINDS = (ValueError, TypeError, IndexError, AssertionError, FloatingPointError)
ROWS = ("R1", "R7")  # the second fails, and is told what would flip it
solve_once = lru_cache(maxsize=None)(solve_scene)
FAULT = re.compile(
    r"internal error, please report it: (?P<kind>\w+): spoilt \d+ times, in "
    r"(?P<place>[\w/]+\.py:\d+)"
)
CASE = re.compile(
    r"  net rows? (?P<rows>[\w, ]+): "
    r"density \S+ kg/m3, friction \S+ deg, inclination \S+ deg, slope \S+ deg, "
    r"snow \S+ m by \S+ m, (?P<method>\w+)"
)


def read_told(text, kind):
    """Net rows and method of every case that was told, below its fault."""
    first, *cases, last = text.splitlines()
    assert FAULT.fullmatch(first)["kind"] == kind.__name__
    assert "NETDESIGN_TRACEBACK" in last
    return [CASE.fullmatch(case).groupdict() for case in cases]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    path = tmp_path_factory.mktemp("site") / "site.xlsx"
    write_rows(path, ROWS)
    return path


@pytest.fixture
def spoil(monkeypatch):
    """Raise in the solves that ``is_hit`` says, by number and settings."""

    def spoil_calls(is_hit=lambda *_: False, kind=ValueError):
        calls = []

        def solve(scene, settings):
            calls.append(settings)
            if is_hit(len(calls) - 1, settings):
                raise kind("spoilt 3 times")
            if isinstance(settings, TransientSettings):
                settings = SolverSettings(accuracy=settings.accuracy)
            return solve_once(scene, settings)

        monkeypatch.setattr(workers_module, "solve_scene", solve)
        return calls

    return spoil_calls


@pytest.fixture
def check(call, site):
    """Exit code, the rows of the study by id, and what was told."""

    def run(*options):
        ended = call("check", site, *QUICK, "--json", "--no-cache", *options)
        return ended.code, read_rows(ended.out), ended.err

    return run


def read_rows(document):
    return {row["id"]: row for row in json.loads(document)["rows"]}


def require_told(rows, sound, told, kind):
    """Every faulty row is not proven and says so; the others are as they were."""
    found = read_told(told, kind)
    assert found
    faulty = {row for one in found for row in one["rows"].split(", ")}
    for name, row in rows.items():
        if name not in faulty:
            assert row == sound[name]
            continue
        assert row["verdict"] != "pass"
        assert "fault.sentence" in json.dumps(
            row
        ) or "check.fault_beside" in json.dumps(row)
    assert "spoilt" not in json.dumps(rows)
    return faulty


@pytest.mark.long
def test_a_fault_in_any_solve_is_told_and_spares_the_other_rows(spoil, check):
    """The first, the last, and six more: cases and other laws."""
    settings = spoil()
    code, sound, told = check()
    assert (code, told) == (1, "")
    number = len(settings)
    draw = random.Random(17)
    drawn = {0, 8, number - 1, *draw.sample(range(number), 6)}
    befallen = set()
    for place in drawn:
        kind = draw.choice(KINDS)
        spoil(lambda call, _, place=place: call == place, kind)
        code, rows, told = check()
        assert code == 5
        befallen |= require_told(rows, sound, told, kind)
    assert befallen == set(ROWS)


def test_a_fault_in_the_statics_of_a_support_is_told_alike(spoil, check, monkeypatch):
    """What follows from a solve in this process spares the other rows, too."""
    spoil()
    _, sound, _ = check()
    calls, solve = [], panel_forces.compute_anchor_forces

    def fail_in_one(*args, **values):
        calls.append(args)
        if len(calls) == 3:
            raise TypeError("spoilt 3 times")
        return solve(*args, **values)

    monkeypatch.setattr(panel_forces, "compute_anchor_forces", fail_in_one)
    code, rows, told = check()
    assert code == 5
    assert len(require_told(rows, sound, told, TypeError)) == 1


def test_every_fault_of_a_run_is_told(spoil, check):
    spoil(lambda *_: True)
    code, rows, told = check()
    assert code == 5
    assert {row["verdict"] for row in rows.values()} == {"not_proven"}
    cases = [case for row in rows.values() for case in row["cases"]]
    assert {case["outcome"] for case in cases} == {"program_fault"}
    assert len(FAULT.findall(told)) == 1
    assert f"{len(cases) - 20} more" in told


def test_all_outputs_are_written_in_plain_words(spoil, call, site, tmp_path):
    spoil(lambda call, _: call == 1)
    ended = call(
        "check", site, *QUICK, "--no-cache", "--language", "fr", "--out", "out"
    )
    assert ended.code == 5
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "le programme lui-même a échoué dans ce cas" in page
    assert str(SENTENCE) not in page
    for text in (page, ended.out):
        assert "spoilt" not in text
        assert "ValueError" not in text
    names = {one.name for one in (tmp_path / "out").glob("[!.]*")}
    assert names == {"report.html", "report.xlsx", "study.json"}


def test_the_whole_way_to_a_fault_is_shown_on_demand(spoil, check, monkeypatch):
    spoil(lambda call, _: call == 1)
    assert "Traceback" not in check()[2]
    monkeypatch.setenv("NETDESIGN_TRACEBACK", "1")
    spoil(lambda call, _: call == 1)
    assert "Traceback" in check()[2]


def test_a_later_run_solves_what_a_fault_left(spoil, call, tmp_path):
    """Neither the case nor a search that had a fault is kept."""
    path, store = tmp_path / "one.xlsx", tmp_path / "cases.sqlite"
    write_rows(path, ["R1"], leans=True)
    run = partial(call, "check", path, *QUICK, "--json")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("NETDESIGN_STORE", str(tmp_path / "sound.sqlite"))
        spoil()
        sound = run()
        patch.setenv("NETDESIGN_STORE", str(store))
        spoil(lambda call, _: call == 2)
        assert run().code == 5
        mended = spoil()
        again = run()
    assert (again.code, read_rows(again.out)) == (sound.code, read_rows(sound.out))
    assert mended


class FaultyScene(Scene):
    """Raises in whatever process it is solved."""

    @property
    def flow_problem(self):
        message = "spoilt 9 times"
        raise TypeError(message)


def is_heavy_and_rough(values):
    return values["density"] > 350.0 and values["friction_angle"] > 0.6


@pytest.mark.parametrize("processes", [1, 2])
def test_a_fault_in_a_process_of_the_pool_is_told_alike(
    call, site, monkeypatch, processes
):
    struck = read_site(site).rows[0].slope_angle  # of R1

    def place(scene, values):
        scene = place_scene(scene, values)
        is_hit = scene.snowpack.slope_angle == struck and is_heavy_and_rough(values)
        given = {name: getattr(scene, name) for name in scene.__dataclass_fields__}
        return FaultyScene(**given) if is_hit else scene

    monkeypatch.setattr(workers_module, "ProcessPool", partial(ProcessPool, worth=1))
    monkeypatch.setattr(envelope_rows, "place_scene", place)
    options = ("--accuracy", "0.1", "--quiet", "--json", "--no-cache")
    ended = call("check", site, *options, "--jobs", processes)
    assert ended.code == 5
    assert {one["rows"] for one in read_told(ended.err, TypeError)} == {"R1"}
    rows = read_rows(ended.out)
    assert rows["R1"]["verdict"] == "not_proven"
    assert rows["R7"]["verdict"] == "fail"
    for case in rows["R1"]["cases"]:
        at = case["case"]
        friction = math.radians(at["friction_deg"])
        is_hit = is_heavy_and_rough(
            {"density": at["density_kg_m3"], "friction_angle": friction}
        )
        assert case["outcome"] == ("program_fault" if is_hit else "converged")


def test_a_lack_of_memory_stays_that_of_its_case(spoil, check):
    spoil(lambda call, _: call >= 2, lambda _: MemoryError())
    code, rows, told = check()
    assert (code, told) == (4, "")
    assert rows["R1"]["verdict"] == "not_proven"
    assert "worker.no_memory" in json.dumps(rows["R1"])


# --- one scene, one envelope ----------------------------------------


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SMALL_SCENE)
    return path


def raise_in_solve(monkeypatch, error):
    def fail(*_):
        raise error

    monkeypatch.setattr(solve_module, "solve_scene", fail)


@pytest.mark.parametrize("method", ["steady", "transient", "staggered"])
def test_a_fault_in_one_scene_leaves_a_valid_document(call, scene, monkeypatch, method):
    raise_in_solve(monkeypatch, IndexError("spoilt 7 times"))
    ended = call("solve", scene, "--method", method, "--json")
    assert ended.code == 5
    document = json.loads(ended.out)
    assert (document["outcome"], document["reason"]) == ("program_fault", str(SENTENCE))
    assert "IndexError: spoilt 7 times, in " in ended.err
    assert "density 300 kg/m3, friction 30 deg, inclination 30 deg" in ended.err
    assert ended.err.count(method) == 1


def test_a_fault_in_one_scene_is_written_to_its_folder(call, scene, monkeypatch):
    raise_in_solve(monkeypatch, IndexError("spoilt 7 times"))
    ended = call("solve", scene, "--out", "out")
    assert ended.code == 5
    text = (scene.parent / "out" / "solution.json").read_text(encoding="utf-8")
    assert str(SENTENCE) in text
    assert "spoilt" not in text + ended.out


def test_a_refusal_of_one_scene_stays_a_refusal(call, scene, monkeypatch):
    raise_in_solve(monkeypatch, ModelError("no such net"))
    ended = call("solve", scene)
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == "error: no such net\n"


@pytest.mark.parametrize("samples", ["", ":3"], ids=["search", "grid"])
def test_a_fault_in_an_envelope_leaves_a_valid_document(call, scene, spoil, samples):
    ranges = ("--density", f"250:400{samples}", "--accuracy", "0.1")
    options = ("--json", "--no-cache", "--quiet", "--jobs", "1")
    calls = spoil()
    assert call("envelope", scene, *ranges, *options).code == 0
    for place in (0, len(calls) - 1):  # the last one confirms
        spoil(lambda call, _, place=place: call == place)
        ended = call("envelope", scene, *ranges, *options)
        assert ended.code == 5
        document = json.loads(ended.out)
        assert document["outcome"] == "not_proven"
        assert str(SENTENCE) in document["reason"]
        assert "spoilt" not in ended.out
        assert "ValueError: spoilt 3 times, in solving/workers.py:" in ended.err
