"""Lists as offices send them, and untidy sites: verdicts under four profiles.

`lists/` holds eight lists with the answers that they were read by, and ten drawn
variants of them (columns moved and renamed, other units, sums between). Ten drawn sites
more have tests one by one, and rows that others go on into. A list that the reader
needs another answer for, gets that in its file of answers; its verdicts stay.
"""

import tempfile
from dataclasses import replace
from pathlib import Path

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from tests.golden.compare import tell_differences
from tests.golden.drawn import (
    HERE,
    PROFILES,
    load,
    read_drawn,
    solve_and_judge,
    store,
)
from tests.golden.places import flatten, state_verdicts

LISTS = HERE / "lists"
ROWS = 2  # of each site


def compare_lists():
    """G3: verdicts of eight lists and twenty untidy sites under four profiles."""
    stored = load("lists")
    return [line for name in stored for line in compare_list(name, stored[name])]


def compare_list(name, then):
    return [f"{name} {line}" for line in tell_differences(then, judge_list(name))]


def judge_list(name):
    """Forces, utilisations and verdicts of a list by profile and place."""
    try:
        site = read_list(name)
    except SiteDataError as refused:
        return {"/refused": str(refused).partition("\n")[0]}
    site = replace(site, rows=site.rows[:ROWS])
    documents = solve_and_judge(site, PROFILES)
    return flatten(dict(zip(PROFILES, map(state_verdicts, documents), strict=True)))


def read_list(name):
    if (path := LISTS / f"{name}.xlsx").is_file():
        return read_site(path)
    with tempfile.TemporaryDirectory() as folder:
        return read_drawn(Path(folder) / "site.xlsx", load("lines")[name])


def store_lists():
    store("lists", {name: judge_list(name) for name in load("lists")})
