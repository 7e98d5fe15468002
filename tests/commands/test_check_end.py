"""A run that was done before: told from the store, or calculated anew; never mixed."""

import copy
import json
import math
import random
import sqlite3
from collections.abc import Mapping
from contextlib import closing
from dataclasses import fields, is_dataclass, replace
from datetime import date, timedelta
from pathlib import Path

import pytest

from netdesign.checks import load_standard
from netdesign.commands import check_steps
from netdesign.commands.check_end import CheckEnd, CheckTask, name_end
from netdesign.commands.check_outputs import plan_outputs
from netdesign.errors import OutputError
from netdesign.evidence.benchmark.versions.inputs import write_site
from netdesign.fault import Fault
from netdesign.outcome import Outcome, Verdict
from netdesign.report.summary import build_summary
from netdesign.report.terminal import dump_summary, restore_summary
from netdesign.site.reader import read_site
from netdesign.solving import finished_runs
from netdesign.solving.runner import Counts, Runner
from netdesign.solving.store import CaseStore
from netdesign.words.catalogue import LANGUAGES
from tests.report.build_study import build_study
from tests.short_example import write_short_example
from tests.small_site import RUN
from tests.test_startup import imported

SITE = ("check", "site", "--accuracy", "0.1", "--jobs", "1")
TOLD = "nothing has changed since the run of"
NO_KINDS = dict.fromkeys(("html", "excel", "csv", "pdf", "docx"), False)
LOOKS = {"language": "en", "detail": "full", "template": None}


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    monkeypatch.setenv("NETDESIGN_STORE", str(tmp_path / "cases.sqlite"))
    monkeypatch.chdir(tmp_path)
    write_site(tmp_path / "site", 1)
    return tmp_path


@pytest.fixture
def calculated(place, monkeypatch):
    """List of calculations, each of which writes its number; nothing is solved."""
    done, runner = [], Runner(store=object())
    CaseStore(place / "cases.sqlite", print).__exit__(None, None, None)

    def calculate(task, _read, **_):
        done.append(task)
        text = f"calculation {len(done)}"
        paths = [path for group in task.outputs.of_studies for path in group]
        end = CheckEnd(
            started=task.run.started,
            exit_code=4,
            verdicts=frozenset({Verdict.PASS}),
            sized=(text,),
            document=f'"{text}"' if task.as_json else "",
            files={path: f"{path.name} of {text}".encode() for path in paths},
        )
        return end, runner

    monkeypatch.setattr(check_steps, "_calculate", calculate)
    return done, runner


def build_task(path, **changes):
    """Task of a site that is read, with two profiles."""
    outputs = plan_outputs(
        Path("out"),
        ["eurocode"],
        NO_KINDS | {"html": True, "csv": True},
        LOOKS | {"detail": "figures"},
        size=False,
        is_what_if=(),
        overwrite=True,
    )
    values = {
        "site": read_site(path),
        "profiles": [load_standard("eurocode"), load_standard("nf-p-95-304-style")],
        "run": RUN,
        "executor": "",
        "outputs": outputs,
        "size": False,
        "explain": False,
        "as_json": False,
    }
    return CheckTask(**(values | changes))


def list_leaves(value, way=()):
    """Ways to every plain value in a value, through fields, members and keys."""
    if is_dataclass(value):
        parts = [(one.name, getattr(value, one.name)) for one in fields(value)]
    elif isinstance(value, Mapping):
        parts = list(value.items())
    elif isinstance(value, tuple | list) and value:
        parts = list(enumerate(value))
    else:
        return [way]
    return [leaf for key, part in parts for leaf in list_leaves(part, (*way, key))]


def alter(value, way):
    """Copy of a value in which the one at the end of a way is another one."""
    if not way:
        return alter_plain(value)
    key, *rest = way
    if is_dataclass(value):
        other = copy.copy(value)
        object.__setattr__(other, key, alter(getattr(value, key), rest))
        return other
    if isinstance(value, Mapping):
        return {**value, key: alter(value[key], rest)}
    return type(value)([*value[:key], alter(value[key], rest), *value[key + 1 :]])


def alter_plain(value):
    if isinstance(value, bool):
        return not value
    if isinstance(value, str | bytes | tuple | list | Mapping):
        return "x" if not value else value[:-1] if len(value) > 1 else value * 2
    if isinstance(value, date):
        return value + timedelta(days=1)
    return "x" if value is None else math.nextafter(value, 0.0) or 5e-324


@pytest.fixture
def quick_names(monkeypatch):
    monkeypatch.setattr(finished_runs, "identify_installation", lambda: "here")


PARTS = ("site", "profiles", "run", "executor", "size", "explain", "as_json")


def test_every_value_that_was_read_or_asked_is_a_part_of_the_name(place, quick_names):
    """45 drawn from all plain values of a site, two profiles, settings and options."""
    write_short_example(place / "site.xlsx", ["R5"])
    task = build_task(place / "site.xlsx")
    ways = [way for way in list_leaves(task) if way[0] in PARTS]
    assert len(ways) > 1000
    drawn = random.Random(1117).sample(ways, 45)
    drawn += [way for way in ways if way[0] not in ("site", "profiles", "run")]
    names = {name_end(task)} | {name_end(alter(task, way)) for way in drawn if way}
    is_time = [way for way in drawn if way == ("run", "started")]
    assert "" not in names
    assert len(names) == 1 + len(set(drawn)) - len(is_time)


def test_reports_are_a_part_of_the_name(place, quick_names):
    task = build_task(place / "site")
    names = {name_end(task)}

    def plan(kinds=(), folder="out", profiles=("eurocode",), **looks):
        wanted = NO_KINDS | {"html": True} | dict.fromkeys(kinds, True)
        planned = plan_outputs(Path(folder), profiles, wanted, LOOKS | looks,
                               size=False, is_what_if=(), overwrite=True)  # fmt: skip
        return name_end(replace(task, outputs=planned))

    others = [
        plan(),
        plan(["csv", "excel"]),
        plan(detail="summary"),
        plan(language="fr"),
        plan(profiles=("eurocode", "nf-p-95-304-style")),
    ]
    assert len(names | set(others)) == 6
    assert plan(folder="elsewhere") == others[0]  # the bytes know no folder


@pytest.mark.parametrize("kind", ["report.pdf", "report.docx"])
def test_a_report_with_fonts_of_the_machine_is_made_every_time(place, kind):
    task = build_task(place / "site")
    paths = [[Path("out/study.json"), Path("out") / kind]]
    assert (
        name_end(replace(task, outputs=replace(task.outputs, of_studies=paths))) == ""
    )


def test_a_site_with_a_value_of_no_known_kind_is_checked_every_time(place):
    task = build_task(place / "site")
    assert name_end(task)
    strange = replace(task.site, notes=(object(),))
    assert name_end(replace(task, site=strange)) == ""


def test_the_same_question_is_told_with_the_same_words(place, call, calculated):
    ended = call(*SITE, "--out", "out", "--force")
    files = {path: path.read_bytes() for path in (place / "out").iterdir()}
    assert len(files) == 3
    again = call(*SITE, "--out", "out", "--force")
    assert {path: path.read_bytes() for path in (place / "out").iterdir()} == files
    assert (again.code, again.out) == (ended.code, ended.out) == (4, again.out)
    started = calculated[0][0].run.started
    (sentence, *wrote) = again.err.splitlines()
    assert sentence.startswith(f"{TOLD} {started}")
    assert "--no-cache" in sentence
    assert "\n".join(wrote) == ended.err.rstrip()
    assert len(calculated[0]) == 1


@pytest.mark.parametrize("language", LANGUAGES[1:])
def test_it_is_said_in_the_language_of_the_run(place, call, calculated, language):
    first, again = (call(*SITE, "--force", "--language", language).err for _ in "12")
    assert len(again.splitlines()) == len(first.splitlines()) + 1
    assert "--no-cache" in again
    assert TOLD not in again


def test_a_quiet_run_and_a_document_have_no_word_more(place, call, calculated):
    first, again = (call(*SITE, "--json", "--quiet") for _ in "12")
    assert (again.out, again.err) == (first.out, "") == ('"calculation 1"\n', "")
    assert len(calculated[0]) == 1


OTHERS = [
    (("--accuracy", "0.0999"), {}),
    (("--jobs", "2"), {}),
    (("--method", "transient"), {}),
    (("--floor", "none"), {}),
    (("--standard", "eurocode"), {}),
    (("--what-if", "Nets.C2=2.41"), {}),
    (("--language", "de"), {}),
    (("--no-html",), {}),
    (("--size",), {}),
    ((), {"SOURCE_DATE_EPOCH": "1700000000"}),
    ((), {"NETDESIGN_CHECK_ACCURACY": "0.07"}),
    ((), {"NETDESIGN_CHECK_EXPLAIN": "1"}),
    ((), {"NETDESIGN_CHECK_SIZE": "1"}),
    ((), {"NETDESIGN_CHECK_EXECUTOR": "dask://127.0.0.1:1"}),
    ((), {"NETDESIGN_CHECK_CSV": "1"}),
    ((), {"NETDESIGN_LANGUAGE": "fr"}),
    ((), {"NETDESIGN_CHECK_DETAIL": "figures"}),
    ((), {"NETDESIGN_CORE": "numpy"}),
    ((), {"OPENBLAS_NUM_THREADS": "3"}),
]


def test_another_question_is_calculated(place, call, calculated, monkeypatch):
    """Each of these by an option, or by a variable that the command does not show."""
    monkeypatch.setattr(finished_runs, "_MOST_RUNS", len(OTHERS) + 1)
    asked = ("check", "site", "--force")
    call(*asked)
    for count, (options, variables) in enumerate(OTHERS, start=2):
        with monkeypatch.context() as patch:
            for name, value in variables.items():
                patch.setenv(name, value)
            ended = call(*asked, *options)
        assert len(calculated[0]) == count, (options, variables, ended.err)
    monkeypatch.setenv("NETDESIGN_CHECK_DELIMITER", ",")  # it is found out as well
    assert TOLD in call(*asked).err
    assert len(calculated[0]) == len(OTHERS) + 1


FILES = [
    ("site/Nets.csv", ",2.5,", ",2.49,"),
    ("site/Project.csv", "Rows", "rows"),
    ("netdesign.toml", "", "[check]\naccuracy = 0.06\n"),
    ("netdesign.toml", "", '[check]\ndetail = "summary"\n'),
    ("site.map.toml", "", 'decimal_mark = "point"\n'),
    ("site/Winter.csv", "", "date,snow height [m]\n2021-01-03,1.3\n"),
    ("mine/limits.toml", "\n", "\n\n"),
    ("mine/NOTES.md", "", "A remark.\n"),
]


def test_another_file_beside_it_is_another_question(place, call, calculated):
    """It is told again as soon as the file is as it was."""
    assert call("standards", "copy", "eurocode", "mine").code == 0
    asked = ("check", "site", "--force", "--standard", "mine")
    assert call(*asked).code == 4
    for count, (name, old, new) in enumerate(FILES, start=2):
        path = place / name
        text = path.read_text(encoding="utf-8") if path.exists() else ""
        changed = text.replace(old, new, 1) if old else text + new
        assert changed != text
        path.write_text(changed, encoding="utf-8")
        ended = call(*asked)
        assert len(calculated[0]) == count, (name, ended.err)
        path.write_text(text, encoding="utf-8") if text else path.unlink()
    assert TOLD in call(*asked).err


def test_a_time_that_was_chosen_is_a_part_of_the_question(
    place, call, calculated, monkeypatch
):
    for epoch in ("1600000000", "1600000001", "1600000000"):
        monkeypatch.setenv("SOURCE_DATE_EPOCH", epoch)
        ended = call(*SITE, "--force")
    assert f"{TOLD} 2020-09-13T12:26:40+00:00" in ended.err
    assert len(calculated[0]) == 2


def test_no_cache_neither_keeps_nor_finds(place, call, calculated):
    asked = (*SITE, "--force")
    call(*asked, "--no-cache")
    call(*asked, "--no-cache")
    call(*asked)
    assert TOLD in call(*asked).err
    call(*asked, "--no-cache")
    assert len(calculated[0]) == 4


@pytest.mark.parametrize("kind", ["fault", "lost", "without a store"])
def test_a_run_that_another_cannot_rely_on_is_not_kept(place, call, calculated, kind):
    done, runner = calculated
    if kind == "fault":
        runner.keep_fault(Fault(kind="ValueError", message="x", place="y"), "R1")
    runner.counts = Counts(lost=int(kind == "lost"))
    runner.store = None if kind == "without a store" else object()
    codes = [call(*SITE, "--force").code for _ in range(2)]
    assert codes == [5 if kind == "fault" else 4] * 2
    assert len(done) == 2


def test_a_case_lost_in_a_worker_of_rows_counts_too():
    runner, theirs = Runner(), Runner()
    theirs.counts.lost = 3
    runner.take(theirs.counts, theirs.faults)
    assert runner.counts.lost == 3


@pytest.mark.parametrize("lost", [Outcome.WORKER_FAILED, Outcome.PROGRAM_FAULT])
def test_the_runner_counts_what_was_lost(lost):
    from netdesign.coupling.solution import FailedSolution
    from netdesign.words.message import say

    runner = Runner()
    for outcome in (lost, Outcome.NO_EQUILIBRIUM):
        failed = FailedSolution(outcome=outcome, reason=say("worker.died"))
        runner._note("a", failed)
    assert (runner.counts.failed, runner.counts.lost) == (2, 1)


def test_what_could_not_be_written_is_not_kept(place, call, calculated, monkeypatch):
    def refuse(_files, *, overwrite):
        raise OutputError("full")

    with monkeypatch.context() as patch:
        patch.setattr(check_steps, "write_files", refuse)
        assert call(*SITE, "--force").code == 2
    assert TOLD not in call(*SITE, "--force").err
    assert len(calculated[0]) == 2


def test_what_is_there_is_not_overwritten_unasked(place, call, calculated):
    assert call(*SITE).code == 4
    refused = call(*SITE)
    assert refused.code == 2
    assert "--force" in refused.err
    assert len(calculated[0]) == 1


def test_a_damaged_run_is_told_and_calculated_anew(place, call, calculated):
    call(*SITE, "--force")
    with closing(sqlite3.connect(place / "cases.sqlite")) as base:
        base.execute("UPDATE runs SET text = replace(text, 'PASS', 'FAIL') || ' '")
        base.commit()
    ended = call(*SITE, "--force")
    assert "is damaged, calculated anew" in ended.err
    assert TOLD not in ended.err
    assert TOLD in call(*SITE, "--force").err
    assert len(calculated[0]) == 2


@pytest.mark.parametrize(
    ("told", "files"),
    [
        ("[]", {}),
        ("{}", {}),
        ('{"started": "x", "exit_code": "one"}', {}),
        (None, {}),
        (None, {"../../elsewhere": b"x"}),
        (None, {"/tmp/elsewhere": b"x"}),
    ],
)
def test_a_sealed_run_that_is_none_is_told_and_left_out(
    place, call, calculated, told, files
):
    """Somebody else's store: it names no place where a file is written."""
    call(*SITE, "--force")
    path = place / "cases.sqlite"
    with closing(sqlite3.connect(path)) as base:
        name, text = base.execute("SELECT name, text FROM runs").fetchone()
    run = finished_runs.FinishedRun(text=told or json.loads(text)["text"], files=files)
    finished_runs.keep_run(path, name, run)
    assert "is damaged" in call(*SITE, "--force").err
    assert len(calculated[0]) == 2
    assert not (place.parent.parent / "elsewhere").exists()


def test_a_store_that_fails_is_told_and_the_run_ends_well(
    place, call, calculated, monkeypatch
):
    def fail(*_):
        raise sqlite3.OperationalError("disk full")

    monkeypatch.setattr(finished_runs, "keep_run", fail)
    ended = call(*SITE, "--force")
    assert ended.code == 4
    assert "the store of cases failed (disk full)" in ended.err


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_summary_survives_the_way_to_the_store_and_back(language):
    summary = build_summary(build_study(), language, explain=True)
    assert summary.changes
    back = restore_summary(json.loads(json.dumps(dump_summary(summary))))
    assert back == summary


def read_outputs(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_a_real_run_is_told_without_any_solver(place, call, monkeypatch):
    """Bytes and words of a run without a store, whose time was chosen."""
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    asked = (*SITE, "--explain")
    command = " ".join(("netdesign", *asked, "--out", "alone"))
    monkeypatch.setattr("netdesign.commands.check.own_command", lambda: command)
    bare = call(*asked, "--no-cache", "--out", "bare")
    kept = call(*asked, "--out", "kept")
    monkeypatch.setattr(check_steps, "_calculate", None)
    again = call(*asked, "--out", "again")
    assert TOLD in again.err
    assert (again.out, again.code) == (kept.out, kept.code) == (bare.out, bare.code)
    outputs = read_outputs(place / "bare")
    assert set(outputs) == {"study.json", "report.html", "report.xlsx"}
    assert read_outputs(place / "kept") == read_outputs(place / "again") == outputs
    modules = imported(*asked, "--out", "alone", cwd=place, whole=True, code=kept.code)
    assert read_outputs(place / "alone") == outputs
    assert "netdesign.solving.finished_runs" in modules
    unused = {"scipy.linalg", "scipy.special", "jinja2", "xlsxwriter", "pandas"}
    unused |= {"matplotlib", "netdesign.study.judge", "netdesign.report.view.whole"}
    assert not modules & unused


@pytest.mark.robustness
def test_drawn_changes_never_bring_bytes_that_are_not_theirs(place, call, monkeypatch):
    """Drawn sites, options and variables through one store, each beside a bare run.

    Two minutes: ``python -m pytest -m robustness tests/commands/test_check_end.py``.
    """
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    monkeypatch.setattr("netdesign.commands.check.own_command", lambda: "netdesign")
    drawn, told = random.Random(24), 0
    nets = (place / "site" / "Nets.csv").read_text(encoding="utf-8")
    for k in range(60):
        thickness = drawn.choice(["2.5", "2.41"])
        changed = nets.replace(",2.5,", f",{thickness},", 1)
        (place / "site" / "Nets.csv").write_text(changed, encoding="utf-8")
        monkeypatch.setenv("OMP_NUM_THREADS", drawn.choice("12"))
        monkeypatch.setenv("NETDESIGN_CHECK_DETAIL", drawn.choice(["full", "summary"]))
        asked = [*SITE, "--language", drawn.choice(["en", "de"])]
        asked += [one for one in ("--explain", "--csv") if drawn.random() < 0.5]
        ended = call(*asked, "--out", f"kept{k}")
        bare = call(*asked, "--out", f"bare{k}", "--no-cache")
        told += TOLD in ended.err or "--no-cache" in ended.err
        assert (ended.out, ended.code) == (bare.out, bare.code)
        kept = read_outputs(place / f"kept{k}")
        assert kept == read_outputs(place / f"bare{k}"), asked
    assert 5 < told < 55
