"""A net row whose numbers are in question: not proven, and no hand makes it a pass."""

from netdesign.checks import load_standard
from netdesign.outcome import Verdict
from netdesign.study.document import read_document, write_document
from netdesign.study.judge import judge_site
from netdesign.words.message import say
from tests.grid import solve_site
from tests.small_site import RUN, build_row, build_site

STANDARD = load_standard("nf-p-95-304-style")
ASKED = say(
    "plausible.asked",
    place="Parts!D2",
    field=say("column.posts.second_moment"),
    text='"3175"',
    rule=say("plausible.diameter", diameter=12.0),
)


def test_the_row_is_not_proven_by_it_alone_and_the_other_one_passes():
    site = build_site(build_row("R1", questions=(ASKED,)), build_row("R2"))
    study = judge_site(site, solve_site(site, RUN), STANDARD, RUN)
    first, second = study.rows
    assert (first.verdict, second.verdict) == (Verdict.NOT_PROVEN, Verdict.PASS)
    open_checks = [one for one in first.checks if one.verdict is not Verdict.PASS]
    assert [one.id for one in open_checks] == ["inputs.plausible"]
    again = read_document(write_document(study))
    (asked,) = (one for one in again.rows[0].checks if one.id == "inputs.plausible")
    assert [point.message for point in asked.open] == [ASKED]
