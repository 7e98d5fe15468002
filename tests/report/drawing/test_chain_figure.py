"""Chains of a row: which links they have, and which is the weakest."""

import math
import random
import re
from dataclasses import replace

from netdesign.outcome import Verdict
from netdesign.report.drawing.chain_figure import draw_chains
from netdesign.report.drawing.plain_svg import WIDTH
from netdesign.report.words import ENGLISH, Words
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.report.drawing.drawn import MODES, build_chains, judge_used
from tests.turn import turn, use

TEXT = re.compile(r'<text x="([\d.]+)" y="([\d.]+)"[^>]*>([^<]*)</text>')
SEEDS = range(12)


def use_row(row, checks, verdict=None):
    """Row whose checks have these utilisations, in their order."""
    pairs = zip(row.checks, checks, strict=True)
    judged = [(one, used, verdict or judge_used(used)) for one, used in pairs]
    return replace(row, checks=[turn(a, v, utilisation=u) for a, u, v in judged])


def list_bold(svg):
    """Bold texts: those of a group that is."""
    groups = re.findall(r'<g [^>]*font-weight="bold"[^>]*>(.*?)</g>', svg, re.DOTALL)
    return re.findall(r"<text [^>]*>([^<]*)<", "".join(groups))


@each("language", LANGUAGES)
@each("seed", SEEDS)
def test_every_check_of_a_force_is_a_link_inside_the_picture(seed, language):
    row = build_chains(random.Random(seed))
    svg = draw_chains(row, Words(language))
    shown = [text for *_, text in TEXT.findall(svg) if ":" in text]
    assert len(shown) == len(row.checks)
    assert sum(text.endswith(": ?") for text in shown) == sum(
        one.utilisation is None for one in row.checks
    )
    right = [float(x) for x in re.findall(r"([\d.]+),[\d.]+ [\d.]+,", svg)]
    assert max(right) <= WIDTH


def test_of_two_places_the_larger_utilisation_counts():
    row = build_chains(random.Random(3))
    inside = turn(row.checks[0], Verdict.PASS, utilisation=0.613)
    end = replace(use(inside, 0.847), position="edge")
    svg = draw_chains(replace(row, checks=[inside, end]), ENGLISH)
    assert "0.85" in svg
    assert "0.613" not in svg
    assert "0.85" in re.search('aria-label="([^"]*)"', svg)[1]
    open_ = turn(end, Verdict.NOT_PROVEN, utilisation=None)
    assert ": ?" in draw_chains(replace(row, checks=[inside, open_]), ENGLISH)


def test_a_link_that_is_not_proven_is_the_weakest():
    """Knowing less makes no other link look stronger."""
    row = build_chains(random.Random(3))
    row = use_row(row, [0.97] * len(row.checks))
    open_ = turn(row.checks[1], Verdict.NOT_PROVEN, utilisation=None)
    checks = [row.checks[0], open_, *row.checks[2:]]
    svg = draw_chains(replace(row, checks=checks), ENGLISH)
    bold = list_bold(svg)
    assert sum(text.endswith(": ?") for text in bold) == 1
    assert svg.count('stroke-width="1.8"') == 1


def test_a_proof_elsewhere_and_nothing_that_resists_are_shown():
    row = build_chains(random.Random(3))
    declared = turn(row.checks[0], Verdict.DECLARED, utilisation=None)
    told = "nothing is left"
    gone = turn(row.checks[1], Verdict.FAIL, utilisation=math.inf, reason=told)
    svg = draw_chains(replace(row, checks=[declared, gone]), ENGLISH)
    assert "†" in svg
    assert "∞" in svg


def test_a_check_that_is_not_proven_shows_its_number_behind_a_mark():
    """A row under too much snow: forces are known, and prove nothing."""
    used = [0.31] * sum(map(len, MODES.values()))
    row = use_row(build_chains(random.Random(3)), used, Verdict.NOT_PROVEN)
    svg = draw_chains(row, ENGLISH)
    shown = [text for *_, text in TEXT.findall(svg) if ":" in text]
    assert all(text.endswith(": ? 0.31") for text in shown)
    assert "bold" not in svg  # nobody knows which is the weakest
    assert 'stroke-width="1.8"' not in svg
