"""Chains of a row: which links they have, and which is the weakest."""

import random
import re
from dataclasses import replace

from netdesign.outcome import Verdict
from netdesign.report.drawing.chain_figure import draw_chains
from netdesign.report.drawing.plain_svg import WIDTH
from netdesign.report.words import ENGLISH, Words
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.report.drawing.drawn import MODES, build_chains

TEXT = re.compile(r'<text x="([\d.]+)" y="([\d.]+)"[^>]*>([^<]*)</text>')
SEEDS = range(12)


def use(row, checks):
    """Row whose checks have these utilisations, in their order."""
    pairs = zip(row.checks, checks, strict=True)
    return replace(row, checks=[replace(one, utilisation=used) for one, used in pairs])


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
    inside = replace(row.checks[0], utilisation=0.613, verdict=Verdict.PASS)
    end = replace(inside, utilisation=0.847, position="edge")
    svg = draw_chains(replace(row, checks=[inside, end]), ENGLISH)
    assert "0.85" in svg
    assert "0.613" not in svg
    assert "0.85" in re.search('aria-label="([^"]*)"', svg)[1]
    open_ = replace(end, utilisation=None, verdict=Verdict.NOT_PROVEN)
    assert ": ?" in draw_chains(replace(row, checks=[inside, open_]), ENGLISH)


def test_a_link_that_is_not_proven_is_the_weakest():
    """Knowing less makes no other link look stronger."""
    row = build_chains(random.Random(3))
    used = [0.97] * len(row.checks)
    row = use(row, used)
    row = replace(row, checks=[replace(x, verdict=Verdict.PASS) for x in row.checks])
    open_ = replace(row.checks[1], utilisation=None, verdict=Verdict.NOT_PROVEN)
    checks = [row.checks[0], open_, *row.checks[2:]]
    svg = draw_chains(replace(row, checks=checks), ENGLISH)
    bold = list_bold(svg)
    assert sum(text.endswith(": ?") for text in bold) == 1
    assert svg.count('stroke-width="1.8"') == 1


def test_a_proof_elsewhere_and_nothing_that_resists_are_shown():
    row = build_chains(random.Random(3))
    declared = replace(row.checks[0], utilisation=None, verdict=Verdict.DECLARED)
    gone = replace(
        row.checks[1], utilisation=None, verdict=Verdict.FAIL, is_unbounded=True
    )
    svg = draw_chains(replace(row, checks=[declared, gone]), ENGLISH)
    assert "†" in svg
    assert "∞" in svg


def test_a_check_that_is_not_proven_shows_its_number_behind_a_mark():
    """A row under too much snow: forces are known, and prove nothing."""
    row = use(build_chains(random.Random(3)), [0.31] * sum(map(len, MODES.values())))
    checks = [replace(one, verdict=Verdict.NOT_PROVEN) for one in row.checks]
    svg = draw_chains(replace(row, checks=checks), ENGLISH)
    shown = [text for *_, text in TEXT.findall(svg) if ":" in text]
    assert all(text.endswith(": ? 0.31") for text in shown)
    assert "bold" not in svg  # nobody knows which is the weakest
    assert 'stroke-width="1.8"' not in svg
