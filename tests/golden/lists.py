"""Lists as offices send them, and drawn sites: verdicts under four profiles."""

import tempfile
from dataclasses import replace
from pathlib import Path

from netdesign.site.reader import read_site
from tests.golden.compare import tell_differences
from tests.golden.drawn import PROFILES, load, read_drawn, solve_and_judge, store
from tests.golden.places import flatten, state_verdicts
from tests.site.lists.answer import answer_list
from tests.site.lists.offices import OFFICES

ROWS = 2  # of each site
LISTS = {office.file: office for office in OFFICES}


def compare_lists():
    """G3: verdicts of five lists and ten drawn sites under four profiles."""
    stored = load("lists")
    return [line for name in stored for line in compare_list(name, stored[name])]


def compare_list(name, then):
    return [f"{name} {line}" for line in tell_differences(then, judge_list(name))]


def judge_list(name):
    """Forces, utilisations and verdicts of a list by profile and place."""
    site = read_list(name)
    documents = solve_and_judge(replace(site, rows=site.rows[:ROWS]), PROFILES)
    return flatten(dict(zip(PROFILES, map(state_verdicts, documents), strict=True)))


def read_list(name):
    with tempfile.TemporaryDirectory() as folder:
        if name not in LISTS:
            return read_drawn(Path(folder) / "site.xlsx", load("lines")[name])
        path = LISTS[name].write(Path(folder))
        answer_list(LISTS[name], path)
        return read_site(path)


def store_lists():
    drawn = [name for name in load("lines") if name.startswith("drawn")]
    store("lists", {name: judge_list(name) for name in (*LISTS, *drawn)})
