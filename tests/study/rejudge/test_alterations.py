"""Whatever is altered in a stored study, `report` refuses it or `verify` notices."""

import json
import random
import re
from contextlib import contextmanager
from dataclasses import replace

import pytest

from netdesign import cli
from netdesign.checks import load_standard
from netdesign.commands import evidence as verify_command
from netdesign.commands import stored_study
from netdesign.outcome import StudyError
from netdesign.site.reader import read_site
from netdesign.solving.runner import Runner
from netdesign.study import check_site as use_case
from netdesign.study.document import compute_digest, read_document, write_document
from netdesign.study.record_provenance import list_differences, record_provenance
from netdesign.study.rejudge import rejudge
from netdesign.words.catalogue import render
from tests.alter_study import alter_leaf, list_leaves
from tests.each import each
from tests.short_example import write_short_example
from tests.study.rejudge.alterations import KINDS
from tests.words.english import find_words

REFUSED = 3
# Which the commands find: they compare the stored command with the run.
OF_COMMAND = (
    *("the command of another accuracy", "the command of another site"),
    *("a command that makes no study", "the command of another profile"),
    "another method",
)
OF_ROWS = ("a row dropped", "rows reordered")  # of a study of one, they change nothing
NOISE = 1e-4  # shares and differences are compared no closer, for other processors
# Only a new solve can tell these: numbers that nothing else in the study follows from,
# or that were altered with everything else.
SOLVE_ONLY = {
    *("a force of one case lowered", "a case added"),
    *("a case dropped", "an error of a case lowered", "drivers altered"),
    *("a line flattened", "a map lowered"),
    *("a confirmation dropped", "a confirmation moved to its case"),
    *("another creep law brought near", "a change that flips a check added"),
    *("an upper bound lowered", "sticking points drawn as sliding"),
    *("a measurement added", "looser tolerances hidden"),
    # not of the document alone: these need the files, or another installation
    *("another hash of the site", "a factor lowered with another hash"),
    *("another version of the program", "other libraries"),
    *("started in the future", "started without a digest"),
}


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """Folder with a site of two net rows that pass, and its study."""
    folder = tmp_path_factory.mktemp("forged")
    write_short_example(folder / "site.xlsx", ["R1", "R2"], is_grid=False, leans=False)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        options = ["--accuracy", "0.0512345678", "--jobs", "1", "--method", "steady"]
        options += ["--quiet", "--no-html", "--no-excel"]
        argv = ["netdesign", "check", "site.xlsx", *options]
        patch.setattr("sys.argv", argv)
        with pytest.raises(SystemExit) as caught:
            cli.main()
    assert caught.value.code == 0
    return folder


@pytest.fixture(scope="module")
def text(home):
    return (home / "netdesign-out" / "study.json").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def site(home):
    return read_site(home / "site.xlsx")


@pytest.fixture(scope="module")
def first(text, site):
    """Study of the first net row alone, and its site: judged in half the time."""
    document = json.loads(text)
    document["rows"] = document["rows"][:1]
    return json.dumps(document), replace(site, rows=site.rows[:1])


@pytest.fixture
def try_both(monkeypatch, call, tmp_path, text, site):
    """Ends of `report`, `verify --study` and `diff` with an altered document.

    The site is read once, and solved once: the solve is the study's own, which
    ``test_verify_study`` shows to come out again.
    """
    fresh = read_document(text)

    @contextmanager
    def solve(*_arguments, **_options):
        yield Runner(), None  # without a fault

    def judge(_site, _profiles, run, _runner, _watch):
        return [replace(fresh, provenance=record_provenance(site, run))]

    monkeypatch.setattr(verify_command, "open_run", solve)
    monkeypatch.setattr(use_case, "check_site", judge)
    for module in (verify_command, stored_study):
        monkeypatch.setattr(module, "read_own_site", lambda *_: site)

    def run(document, *, seal=True):
        path = tmp_path / "study.json"
        written = json.dumps(document)
        if seal and document["digest"]:
            written = write_document(read_document(written))
        path.write_text(written, encoding="utf-8")
        options = ("--no-html", "--no-excel", "--force")
        return (
            call("report", path, *options),
            call("verify", "--study", path),
            call("diff", path, path),
        )

    return run


@pytest.mark.long
def test_the_study_itself_is_rendered_and_verified(try_both, text):
    ended = try_both(json.loads(text))
    assert [one.code for one in ended] == [0, 0, 0]
    assert "same bytes" in ended[1].out


@pytest.fixture(scope="module")
def contradictions(text, site, first):
    """What `rejudge` finds of each kind of alteration; None of one that is no study.

    Beside it whether the study differs from a new solve.
    """
    profile, found = load_standard(read_document(text).profile.id), {}
    for kind, alter in KINDS.items():
        whole, of_site = (text, site) if kind in OF_ROWS else first
        document = json.loads(whole)
        alter(document)
        try:
            study = read_document(json.dumps(document))
        except StudyError:
            found[kind] = None
        else:
            differs = bool(list_differences(study, read_document(whole))[1])
            found[kind] = differs, rejudge(study, profile, of_site)
    return found


def test_the_first_row_alone_is_sound(first):
    text, site = first
    study = read_document(text)
    assert rejudge(study, load_standard(study.profile.id), site) == []


@pytest.mark.long
@each("kind", [one for one in KINDS if one not in OF_COMMAND])
def test_an_alteration_contradicts_itself_or_a_new_solve(contradictions, kind):
    found = contradictions[kind]
    is_found = found is None or bool(found[1])
    assert is_found is (kind not in SOLVE_ONLY)
    if not is_found and not kind.startswith(("another ", "other ", "started ")):
        assert found[0]


# Every twentieth kind, in the long run all: the commands say what was found.
@pytest.mark.parametrize(
    "kind",
    [
        pytest.param(kind, marks=() if k % 20 == 0 else pytest.mark.long)
        for k, kind in enumerate(KINDS)
        if kind not in OF_COMMAND
    ]
    + [*OF_COMMAND],
)
def test_an_alteration_is_refused_or_noticed(try_both, text, kind):
    document = json.loads(text)
    KINDS[kind](document)
    rendered, verified, compared = try_both(document)
    assert verified.code in (1, 3, 4), verified.out
    assert (compared.code == REFUSED) is (rendered.code == REFUSED), compared.err
    assert (rendered.code == REFUSED) is (kind not in SOLVE_ONLY), rendered.err


def test_there_are_many_kinds_of_alterations():
    assert len(KINDS) >= 35
    assert set(KINDS) > SOLVE_ONLY


def shorten(part):
    """The first members of every list: all names of values, few values."""
    if isinstance(part, dict):
        return {key: shorten(one) for key, one in part.items()}
    return [shorten(one) for one in part[:4]] if isinstance(part, list) else part


def list_draws(text, seed):
    """Studies with one value of each name altered, beside the value's path."""
    draw, whole = random.Random(seed), json.dumps(shorten(json.loads(text)))
    leaves = list_leaves(json.loads(whole))
    named = {tuple(p for p in path if isinstance(p, str)): path
             for path in draw.sample(leaves, len(leaves))}  # fmt: skip
    yield (), read_document(whole)
    for name, path in named.items():
        if name not in (("schema",), ("digest",)):
            document = json.loads(whole)
            if alter_leaf(document, path, draw) > NOISE:
                yield name, read_document(json.dumps(document))


@pytest.mark.long
def test_whatever_is_altered_and_not_sealed_is_under_the_digest(text):
    (_, study), *draws = list_draws(text, 171)
    digests = {compute_digest(one) for _, one in draws}
    assert len(digests - {compute_digest(study)}) == len(draws) > 150


@pytest.mark.long
def test_whatever_is_altered_differs_from_a_new_solve(text):
    """Whoever seals a document again meets the new solve, save what nobody knows."""
    (_, fresh), *draws = list_draws(text, 172)
    told_beside = {("provenance", key) for key in ("version", "libraries")}
    for name, study in draws:
        _, found = list_differences(study, fresh)
        assert bool(found) is (name[:2] not in told_beside), name


@pytest.mark.long
def test_a_study_without_its_files_is_audited_all_the_same(text):
    """Alone, a study still has to agree with itself."""
    alone = []
    for kind, alter in KINDS.items():
        document = json.loads(text)
        alter(document)
        if rejudge(read_document(json.dumps(document))):
            alone.append(kind)
    assert len(alone) >= 30
    assert rejudge(read_document(text)) == []


def test_no_check_of_a_force_can_be_taken_from_a_study_without_its_files(first):
    """What is missing was not proven: the verdict of the rest says nothing."""
    text, _ = first
    count = len(json.loads(text)["rows"][0]["checks"])
    lost = []
    for number in range(count):
        document = json.loads(text)
        check = document["rows"][0]["checks"].pop(number)
        if not rejudge(read_document(json.dumps(document))):
            lost.append(check["id"])
    without_force = [x for x in lost if x.startswith("geometry.") or "direction" in x]
    assert lost == without_force


def test_a_check_that_stands_twice_is_found_without_the_files(text):
    document = json.loads(text)
    checks = document["rows"][0]["checks"]
    checks.append(dict(checks[3]))
    assert rejudge(read_document(json.dumps(document)))


# Parts of a study from which no verdict follows: pictures, other models, the way of the
# search, what was solved beside the checks. Only a new solve shows those.
BESIDE = {
    *("drawing", "envelope", "model_form", "statics", "panel", "guideline"),
    *("holds", "spreads", "changes", "provenance", "digest", "sha256", "cases"),
    *("independent", "is_floor_overruled", "hidden_tension_kN", "share"),
    "solved_tension_kN",
    *("uphill_at_deg", "downhill_at_deg", "post_at_deg", "schema"),
}


def find_missed(text, site, seed, count):
    """Places of drawn values that were altered and not found, of those that decide."""
    draw, standard = random.Random(seed), load_standard(read_document(text).profile.id)
    leaves = list_leaves(json.loads(text))
    decide = [path for path in leaves if not BESIDE & set(path)]
    named = {tuple(p for p in path if isinstance(p, str)): path for path in decide}
    assert len(named) > 100
    for path in draw.sample(decide, count):
        document = json.loads(text)
        if alter_leaf(document, path, draw) <= NOISE:
            continue
        try:
            study = read_document(json.dumps(document))
        except StudyError:
            continue
        if not (rejudge(study, standard) or rejudge(study, standard, site)):
            yield path


def test_drawn_alterations_of_what_decides_are_found(first):
    assert list(find_missed(*first, 36, 20)) == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(10))
def test_ten_thousand_drawn_alterations_are_found(text, site, seed):
    assert list(find_missed(text, site, 3600 + seed, 1000)) == []


@pytest.mark.long
def test_every_contradiction_is_told_in_the_language(contradictions):
    """Names and values of the document are its own."""
    found = {one for made in contradictions.values() if made for one in made[1]}
    own = re.compile(r"'[^']*'|\[.*?\]|\w+_\w+|\w+[.]\S+")
    for language in ("fr", "de"):
        told = {own.sub(" ", render(one, language)) for one in found}
        assert len(told) > 50
        assert [one for one in told if find_words(one, ["en"])] == []


def test_a_profile_of_another_hash_says_nothing(text):
    study = read_document(text)
    assert rejudge(study, load_standard("eurocode")) == []


def test_report_reads_the_site_file_itself(call, home, text, tmp_path):
    """Given or beside the study; where there is none, that is said."""
    document = json.loads(text)
    KINDS["a row dropped"](document)
    path = tmp_path / "study.json"
    path.write_text(write_document(read_document(json.dumps(document))))
    options = ("--no-html", "--no-excel", "--force")
    alone = call("report", path, *options)
    assert alone.code == 0
    assert "not compared with its site file: " in alone.err
    given = call("report", path, "--site", home / "site.xlsx", *options)
    assert given.code == REFUSED
    assert "the study has net rows ['R1'], its site file ['R1', 'R2']" in given.err
    (tmp_path / "site.xlsx").write_bytes((home / "site.xlsx").read_bytes())
    assert call("report", path, *options).err == given.err


def test_report_refuses_files_of_another_study(call, home, text, tmp_path):
    path = tmp_path / "study.json"
    path.write_text(text, encoding="utf-8")
    write_short_example(tmp_path / "other.xlsx", ["R3"])
    for option, value in (("--site", "other.xlsx"), ("--standard", "eurocode")):
        ended = call("report", path, option, value, "--no-html", "--no-excel")
        assert ended.code == REFUSED
        assert "other SHA-256" in ended.err
