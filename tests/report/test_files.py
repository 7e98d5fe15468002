"""Contents of a study's files, together and each on its own."""

import pickle
from pathlib import Path

from netdesign.report.files import ReportStyle, render_files, render_kind
from tests.report.build_study import build_study

KINDS = (".html", ".xlsx", ".csv", ".json")
STUDY = build_study(rows=1)


def test_another_process_can_make_each_file():
    """From what was pickled comes what one process makes of all files together."""
    style = ReportStyle(language="fr")
    paths = [Path(f"one{kind}") for kind in KINDS]
    together = render_files([STUDY], [paths], style)
    assert set(together) == set(paths)
    render, study, other = pickle.loads(pickle.dumps((render_kind, STUDY, style)))
    alone = {path: render(path.suffix, study, other) for path in paths}
    assert alone == together
