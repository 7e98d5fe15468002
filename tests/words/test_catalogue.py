"""Every text in every language, and every message of the program with its text."""

import ast
import pickle
import re
import tomllib

import pytest

from netdesign.edge.input_files import find_resource
from netdesign.words.catalogue import LANGUAGES, load_texts, render
from netdesign.words.message import say
from tests.sources import PACKAGE, list_calls
from tests.words.gaps import list_gaps

TEXTS = {language: load_texts(language) for language in LANGUAGES}
# Keys that are put together from the values of an enum or of a table.
FAMILIES = (
    *("column.", "sheet.", "choice.", "quantity.", "delimiter.", "ground_kind."),
    *("symbol.", "finding.error", "finding.question"),
    *("finding.note", "case_count.", "outcome.", "ended.", "member.", "mode."),
    *("basis.", "status.", "axis.", "evidence.", "termination."),
    *("verdict.", "meaning.", "factor.", "creep_law.", "of_scope."),
    *("geometry.inclination_", "geometry.slope_", "geometry.height_"),
    *("geometry.gap_", "geometry.spacing_", "winter_column.", "winter_outcome."),
    *("day_outcome.", "label.", "load_case.", "load.", "load_name."),
    *("load_force.", "product_source.", "resistance_source."),
    *("plausible.source_", "opinion.", "schedule.", "scope.", "todo.", "who."),
    *("condition.", "diff_part.", "decision.", "matrix.", "anchors."),
    *("row_page.", "worked.", "tests.", "assumed_range.", "rated.", "documents."),
    *("panel_view.", "rewrite.of_", "assumed_word.", "assumed_source."),
    *("floor.profile_", "route.", "shared_sum.", "reference.", "piece."),
    *("verify_table.", "against_figure.", "against_clock.", "against_table."),
    *("bench_word.", "bench_plot.", "bench_value.", "validation."),
    *("validation_member.", "method.", "method_used.", "setting.", "start."),
    *("end.", "paper_value.", "paper_plate.", "reliability.", "source."),
    *("variable.", "distribution.", "consequences.", "profile_about."),
    *("profile_title.", "profile_text.", "profile_choice.", "profile_source."),
    *("diff_value.", "diff_check.", "diff_project.", "diff_area."),
)


# Files of words that are English only: help, evidence, add-on pages, errors of the
# program. All others - reports with workbook and document, template, findings on the
# input, the table on the terminal - every language has.
ENGLISH_ONLY = (
    *("bench", "commands", "errors", "evidence", "files", "paper", "validation"),
    "winter",
)
FOLDER = PACKAGE / "words"


def list_keys(language, file):
    """Keys of one file, of whatever depth."""
    tables = [("", tomllib.loads((FOLDER / language / file).read_text("utf-8")))]
    for above, table in tables:
        for name, value in table.items():
            key = f"{above}.{name}".removeprefix(".")
            if isinstance(value, str):
                yield key
            else:
                tables.append((key, value))


@pytest.mark.parametrize("language", ["fr", "de"])
def test_a_language_has_every_text_of_the_translated_files(language):
    files = {path.name for path in (FOLDER / "en").iterdir()}
    files -= {f"{name}.toml" for name in ENGLISH_ONLY}
    assert {path.name for path in (FOLDER / language).iterdir()} == files
    for file in files:
        assert set(list_keys(language, file)) == set(list_keys("en", file)), file


@pytest.mark.parametrize("language", ["fr", "de"])
def test_a_text_that_a_language_lacks_is_english_with_what_it_fills_in(language):
    inner = say("unit.count_cases", count=3)
    message = say("config.bad_value", place="jobs", value="0", reason=inner)
    assert render(message, language) == render(message, "en")
    outer = say("cli.error", reason=message)
    assert render(outer, language).endswith(render(message, "en"))
    assert render(outer, language) != render(outer, "en")


@pytest.mark.parametrize("language", ["fr", "de"])
def test_every_text_has_the_same_gaps(language):
    differing = {
        key: (text, TEXTS["en"].get(key))
        for key, text in TEXTS[language].items()
        if list_gaps(text) != list_gaps(TEXTS["en"].get(key, "{no such text}"))
    }
    assert differing == {}


def list_messages():
    """Every ``say("key", name=...)`` of the program: place, key, names.

    The reports ask ``words("key", name=...)``, or ``book.words(...)``.
    """
    for module, node, called in list_calls():
        if called in ("say", "words") and len(node.args) == 1:
            (key,) = node.args
            if isinstance(key, ast.Constant):
                names = {one.arg for one in node.keywords}
                yield f"{module}:{node.lineno}", key.value, names


def test_every_message_has_a_text_and_all_its_arguments():
    wrong = [
        (place, key, names)
        for place, key, names in list_messages()
        if None not in names  # **arguments are for the other tests
        and names != list_gaps(TEXTS["en"].get(key, "{no such text}"))
    ]
    assert wrong == []


def test_every_text_that_a_template_asks_for_is_there_with_its_gaps():
    wrong = [
        (path.name, key)
        for path in find_resource("templates").rglob("*.html")
        for key, given in re.findall(
            r't\("([^"]+)"((?:, \w+=[^,()]+)*)\)', path.read_text(encoding="utf-8")
        )
        if set(re.findall(r", (\w+)=", given))
        != list_gaps(TEXTS["en"].get(key, "{no such text}"))
    ]
    assert wrong == []


def test_no_text_is_idle():
    files = [*PACKAGE.rglob("*.py"), *find_resource("templates").rglob("*.html")]
    source = "\n".join(path.read_text(encoding="utf-8") for path in files)
    named = set(re.findall(r"[\"']([a-z0-9_]+(?:\.[a-z0-9_]+)+)[\"']", source))
    # the reports list headings of tables and sheets without their family
    named |= {f"heading.{name}" for name in re.findall(r'"([a-z0-9_]+)"', source)}
    idle = {
        key for key in TEXTS["en"] if key not in named and not key.startswith(FAMILIES)
    }
    assert idle == set()


def test_a_message_goes_from_process_to_process():
    message = say("unit.count_cases", count=3)
    assert pickle.loads(pickle.dumps(message)) == message


def test_an_argument_that_lacks_is_a_fault():
    with pytest.raises(KeyError, match="count"):
        render(say("unit.count_cases"), "en")
