from netdesign.report.blocks import write_csv


def test_csv_keeps_every_digit_and_leaves_gaps_empty():
    content = write_csv(["a", "b"], [[0.1 + 0.2, None]])
    assert content == b"a,b\n0.30000000000000004,\n"
