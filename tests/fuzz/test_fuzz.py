"""Fuzzing: no input ends in a traceback, a hang, a wrong exit code, a lying number.

NETDESIGN_FUZZ_SEED=7 NETDESIGN_FUZZ_EXAMPLES=20000 python -m pytest -m fuzz -s ...
"""

import copy
import io
import json
import math
import os
import shutil
import signal
import sqlite3
import tempfile
import time
import tomllib
import zipfile
from contextlib import contextmanager, suppress
from dataclasses import fields, is_dataclass, replace
from functools import cache

import pytest
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from netdesign import cli
from netdesign.checks import load_standard
from netdesign.coupling.solution import FailedSolution
from netdesign.edge.input_files import find_resource
from netdesign.files.scene import read_scene
from netdesign.outcome import NetDesignError, Outcome, SiteDataError
from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.columns.office import TABLES, load_plan
from netdesign.site.reader import read_site
from netdesign.site.template.annotate import annotate_workbook
from netdesign.site.template.office_workbook import write_site_workbook
from netdesign.solving.store import CaseStore, StoreError
from netdesign.study.document import read_document, write_document
from netdesign.words.message import say
from tests.full_scene import FULL_SCENE
from tests.program import call_program
from tests.report.build_study import build_study
from tests.site.conftest import SOUND

IN_THE_SUITE = 200
EXAMPLES = int(os.environ.get("NETDESIGN_FUZZ_EXAMPLES", "100000"))
SEED = int(os.environ.get("NETDESIGN_FUZZ_SEED", "20261121"))
SECONDS = 20  # for one input; a hang ends as a find
REFUSED = 3
STANDARDS = find_resource("standards")
# Where infinity means "none is given", or "and more".
MAY_BE_INFINITE = {"gap", "rows"}

# --- what ends soundly ---------------------------------------------------------------


class HungError(BaseException):
    """An input took longer than any may; nothing in the program catches it."""


@contextmanager
def time_limit():
    def stop(*_):
        raise HungError

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def is_shown_only(text):
    return all(sign.isprintable() or sign in "\n\u00a0" for sign in text)


def attempt(read, *arguments):
    """What ``read`` gives, or the error by which it refuses its input."""
    try:
        found = read(*arguments)
    except NetDesignError as refusal:
        found = refusal
    if not isinstance(found, NetDesignError):
        assert_finite(found)
        return found
    message = str(found)
    assert found.exit_code == REFUSED, message
    assert message.strip()
    assert len(message) < 200_000
    # the command line prints findings as they are, all else without such signs
    assert is_shown_only(message) or not isinstance(found, SiteDataError)
    return found


def assert_finite(value, name=""):
    if is_dataclass(value) and not isinstance(value, type):
        for field in fields(value):
            assert_finite(getattr(value, field.name), field.name)
    elif isinstance(value, list | tuple):
        for one in value:
            assert_finite(one, name)
    elif isinstance(value, float):
        assert not math.isnan(value), name
        assert math.isfinite(value) or name in MAY_BE_INFINITE, name


def run(words, *codes):
    """The program on words of a shell: it ends with one of these codes, in words."""
    ended = call_program(*words)
    assert ended.code in (REFUSED, *codes), (ended.code, ended.err)
    assert "internal error, please" not in ended.err, ended.err
    assert is_shown_only(ended.err), ended.err
    return ended.code


# --- what is drawn -------------------------------------------------------------------

NUMBERS = st.one_of(
    st.floats(),
    st.integers(min_value=-(10**400), max_value=10**400),
    st.sampled_from([0, -0.0, 1e308, 5e-324, 2**63, 10**4000 // 7]),
)
WRITTEN = st.one_of(
    st.floats().map(repr),
    st.floats(-1e6, 1e6).map(lambda x: f"{x:.3f}".replace(".", ",")),
    st.sampled_from(
        [
            *("1.234,5", "1'000", "1 000,5", "1,234", "1e999", "-1e-999", "nan", "inf"),
            *("١٢", "½", "²", "0x10", "1_000", "--1", "+1", "1e", ".", ",", "-", "−3"),
            *("40°", "40 %", "4 m", "4m", "100 kN", "270 kg/m³", "400-500", "10..20"),
            *("=1+1", "#REF!", "TRUE", "wahr", "ja", "x", " ", "\u00a0", "\t", "\n"),
            *("free", "sliding", "no-slip", "glissant", "R1", "A1", "tested", "essai"),
            *("\x00", "\x1b[2J", "\u202e", "\ud800", "\ufeff", "\u2028", "9" * 400),
        ]
    ),
)
SIGNS = st.text(max_size=12)
TYPED = st.one_of(WRITTEN, SIGNS)
KNOWN_WORDS = st.sampled_from(
    sorted(
        {
            name
            for plan in (*SHEETS, *map(load_plan, TABLES))
            for field in plan.fields
            for name in field.names
        }
    )
)
UNITS = st.sampled_from(
    [
        *("", "[m]", "[kN]", "[kN/m]", "[deg]", "[°]", "[%]", "(cm)", "in mm", "[-]"),
        *("[kg/m3]", "[g/cm3]", "[]", "[", "[m][kN]", "[N/mm²]", "[furlong]", "[MN]"),
    ]
)
HEADINGS = st.tuples(st.one_of(KNOWN_WORDS, SIGNS), UNITS).map(" ".join)
VALUES = st.recursive(
    st.one_of(st.none(), st.booleans(), NUMBERS, TYPED),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(SIGNS, inner, max_size=3)
    ),
    max_leaves=5,
)


@st.composite
def spoilt_bytes(draw, sound):
    """Sound content with signs changed, cut off, put in or doubled; or noise."""
    if draw(st.integers(0, 9)) == 0:
        return draw(st.binary(max_size=2000))
    content = bytearray(sound())
    for _ in range(draw(st.integers(1, 6))):
        place = draw(st.integers(0, max(len(content) - 1, 0)))
        long = draw(st.sampled_from([0, 1, 8, 200]))
        written = draw(WRITTEN).encode("utf-8", "surrogatepass")
        others = st.sampled_from([b"", written, bytes(content[place : place + 200])])
        content[place : place + long] = draw(st.one_of(st.binary(max_size=8), others))
    return bytes(content)


@st.composite
def spoilt_tree(draw, sound, values=VALUES):
    """Sound tables or documents with values changed, keys taken away or put in."""
    tree = copy.deepcopy(sound())
    for _ in range(draw(st.integers(1, 4))):
        node = tree
        while keys := list(node) if isinstance(node, dict) else list(range(len(node))):
            key = draw(st.sampled_from(keys))
            if isinstance(node[key], dict | list) and draw(st.integers(0, 7)):
                node = node[key]
                continue
            change = draw(st.integers(0, 9))
            if change == 0:
                del node[key]
            elif change == 1 and isinstance(node, dict):
                node[draw(SIGNS)] = draw(values)
            elif change == 1:
                node.append(copy.deepcopy(node[key]))
            elif isinstance(node[key], int | float) and change < 8:
                node[key] = draw(NUMBERS)
            else:
                node[key] = draw(values)
            break
    return tree


def write_toml(tables):
    """TOML of tables, each value inline."""
    lines = (f"{json.dumps(key)} = {inline(value)}\n" for key, value in tables.items())
    return "".join(lines).encode("utf-8", "surrogatepass")


def inline(value):
    if isinstance(value, bool) or value is None:
        return json.dumps(bool(value))
    if isinstance(value, int) and abs(value) > 2**63:
        return hex(max(value, 0))
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, list):
        return "[" + ", ".join(map(inline, value)) + "]"
    if isinstance(value, dict):
        inside = (f"{json.dumps(key)} = {inline(one)}" for key, one in value.items())
        return "{" + ", ".join(inside) + "}"
    return json.dumps(value)


def write_cells(rows):
    """Rows of cells as a csv file; what a cell cannot be is written as text."""
    lines = []
    for row in rows if isinstance(rows, list) else [rows]:
        cells = [
            "" if cell is None else str(cell)
            for cell in (row if isinstance(row, list) else [row])
        ]
        quoted = ('"' + cell.replace('"', '""') + '"' for cell in cells)
        lines.append(";".join(quoted))
    return "\n".join(lines).encode("utf-8", "surrogatepass")


# --- the targets: each writes into an empty folder, the current one ------------------


@cache
def sound_parts():
    with tempfile.TemporaryDirectory() as folder:
        write_site_workbook(f"{folder}/sound.xlsx", example=True)
        with zipfile.ZipFile(f"{folder}/sound.xlsx") as archive:
            return {name: archive.read(name) for name in archive.namelist()}


@st.composite
def spoilt_parts(draw):
    """A workbook in which the XML of one part is spoilt, not its packing."""
    name = draw(st.sampled_from(sorted(sound_parts())))
    return sound_parts() | {name: draw(spoilt_bytes(lambda: sound_parts()[name]))}


def try_workbook(folder, parts):
    path = folder / "site.xlsx"
    with zipfile.ZipFile(path, "w") as archive:
        for part, content in parts.items():
            archive.writestr(part, content)
    found = attempt(read_site, path)
    if isinstance(found, SiteDataError):
        copied = attempt(annotate_workbook, path, found.findings)
        assert isinstance(copied, NetDesignError) or zipfile.is_zipfile(
            io.BytesIO(copied)
        )


def try_csv(folder, content):
    (folder / "site.csv").write_bytes(content)
    attempt(read_site, folder / "site.csv")


def try_cells(folder, tables):
    for name, rows in tables.items():
        if name in SOUND:
            (folder / f"{name}.csv").write_bytes(write_cells(rows))
    attempt(read_site, folder)


def try_scene(folder, tables):
    (folder / "scene.toml").write_bytes(write_toml(tables))
    attempt(read_scene, folder / "scene.toml")


@st.composite
def spoilt_profile(draw):
    path = draw(st.sampled_from(sorted(STANDARDS.glob("*/*.toml"))))
    return path, draw(spoilt_tree(lambda: tomllib.loads(path.read_text("utf-8"))))


def try_profile(folder, drawn):
    path, tables = drawn
    shutil.copytree(path.parent, folder / "profile")
    (folder / "profile" / path.name).write_bytes(write_toml(tables))
    found = attempt(load_standard, folder / "profile")
    if not isinstance(found, NetDesignError):
        limits = (one for one in found.values if not one.id.startswith("snow.c"))
        assert all(one.value > 0.0 for one in limits)


@cache
def sound_study():
    return json.loads(write_document(build_study()))


def try_study(folder, document):
    found = attempt(read_document, json.dumps(document))
    if not isinstance(found, NetDesignError):
        again = read_document(write_document(found))
        assert replace(again, digest="") == replace(found, digest="")


def try_report(folder, document):
    """A spoilt study that is read is reported, or refused as contradicting itself."""
    (folder / "study.json").write_text(json.dumps(document))
    code = run(["report", "study.json", "--out", "out", "--csv"], 0, 1, 4, 5)
    if code in (REFUSED, 5):
        assert not (folder / "out").exists()
        return
    verdicts = [row["verdict"] for row in document["rows"]]
    assert code or (verdicts and set(verdicts) == {"pass"})


FLAGS = sorted(
    {
        flag
        for command in cli.cli.commands.values()
        for param in getattr(command, "commands", {"": command}).values()
        for option in param.params
        for flag in (*option.opts, *option.secondary_opts)
        if flag.startswith("-")
    }
    - {"--example"}  # which would be calculated, for a long time
)
QUICK = ("check", "solve", "envelope", "report", "diff", "standards")
# Those that calculate or write on their own: only their options are read.
SLOW = ("bench", "doctor", "paper", "verify", "init")
WORDS = st.one_of(
    st.sampled_from(FLAGS),
    TYPED,
    st.sampled_from(
        [
            *("-", "--", "-x", "--jobs=0", "--jobs=-1", "--accuracy=nan", "site.csv"),
            *("scene.toml", "study.json", ".", "/", "missing.xlsx", "250:450", "1:2:3"),
            *("450:250", "nan:1", "1:1", "1:2:3:4", "en", "fr", "de", "steady"),
            *("\udcff", "mesh", "none", "dask://", "dask://x", "a/b.xlsx", "--="),
        ]
    ),
)
SITE = "id;slope\n1;2\n"


def try_options(folder, drawn):
    """Every command with every option, on inputs that are refused or missing."""
    command, words = drawn
    (folder / "site.csv").write_text(SITE)
    (folder / "scene.toml").write_text("[slope]\nangle_deg = 900\n")
    (folder / "study.json").write_text("{}")
    words = [one for one in words if not {"\0", "\ud800"} & set(one)]  # no shell can
    run([command, *(["--no-such-option"] if command in SLOW else []), *words], 0, 2)
    made = {path.name for path in folder.iterdir()}
    assert not [name for name in made if name.endswith((".html", ".json.tmp"))]


def try_defaults(folder, tables):
    (folder / "site.csv").write_text(SITE)
    (folder / "netdesign.toml").write_bytes(write_toml(tables))
    run(["check", "site.csv"], 2)


END = FailedSolution(
    outcome=Outcome.DIVERGED, reason=say("text.as_given", text="residual grew")
)


@cache
def sound_store(path):
    with CaseStore(path, lambda _: None) as store:
        for number in range(3):
            store.keep(str(number), END)
        store._base.execute("PRAGMA journal_mode = DELETE")
    return path.read_bytes()


def try_store(folder, content):
    """A spoilt store gives the cases as they were kept, or none, or is set aside."""
    path = folder / "cases.sqlite"
    path.write_bytes(content)
    with suppress(StoreError, sqlite3.Error), CaseStore(path, lambda _: None) as store:
        for end in store.find(["0", "1", "2"]).values():
            assert (end.outcome, str(end.reason)) == (END.outcome, str(END.reason))


OPTIONS = st.dictionaries(
    st.one_of(st.sampled_from([one.lstrip("-") for one in FLAGS]), SIGNS),
    VALUES,
    max_size=4,
)
COMMANDS = st.sampled_from(sorted(cli.cli.commands))
# What is drawn, what is done with it, and its share of all examples.
TARGETS = {
    "workbook": (spoilt_parts(), try_workbook, 0.07),
    "csv": (spoilt_bytes(lambda: write_cells(SOUND["Rows"])), try_csv, 0.15),
    "cells": (spoilt_tree(lambda: SOUND, st.one_of(TYPED, HEADINGS)), try_cells, 0.3),
    "scene": (spoilt_tree(lambda: tomllib.loads(FULL_SCENE)), try_scene, 0.2),
    "profile": (spoilt_profile(), try_profile, 0.08),
    "study": (spoilt_tree(sound_study), try_study, 0.07),
    "report": (spoilt_tree(sound_study), try_report, 0.01),
    "options": (
        st.tuples(st.sampled_from((*QUICK, *SLOW)), st.lists(WORDS, max_size=6)),
        try_options,
        0.07,
    ),
    "defaults": (st.dictionaries(COMMANDS, OPTIONS, max_size=2), try_defaults, 0.04),
    "store": (None, try_store, 0.01),
}


def try_many(name, examples, home, **chosen):
    """Try a target's share of so many inputs; the share, and how many were tried."""
    drawn, try_one, share = TARGETS[name]
    if drawn is None:
        drawn = spoilt_bytes(lambda: sound_store(home / "sound.sqlite"))
    count, tried = max(10, round(examples * share)), 0
    folder = home / "drawn"

    @settings(
        max_examples=count,
        suppress_health_check=list(HealthCheck),
        phases=(Phase.generate, Phase.shrink),
        **chosen,
    )
    @given(drawn)
    def try_all(one):
        nonlocal tried
        tried += 1
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        with pytest.MonkeyPatch.context() as patch, time_limit():
            patch.chdir(folder)
            try_one(folder, one)

    (try_all if chosen else seed(SEED)(try_all))()
    return count, tried


@pytest.mark.long
@pytest.mark.parametrize("name", TARGETS)
def test_a_few_inputs_end_soundly(name, tmp_path):
    count, tried = try_many(name, IN_THE_SUITE, tmp_path, derandomize=True)
    assert tried >= 0.5 * count


@pytest.mark.fuzz
@pytest.mark.parametrize("name", TARGETS)
def test_very_many_inputs_end_soundly(name, tmp_path, capsys):
    start = time.perf_counter()
    count, tried = try_many(name, EXAMPLES, tmp_path)
    elapsed = time.perf_counter() - start
    with capsys.disabled():
        print(f"\n{name}: {tried} of {count} tried, {elapsed:.0f} s")  # noqa: T201
    assert tried >= 0.9 * count
