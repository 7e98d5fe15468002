"""Three complete net rows by hand, from the net's pulls to the utilisations.

Given are the pulls of the net on foot and head. Everything behind is worked out here
with a pocket calculator's steps, from the sources named beside each step, without a
function of the program; then the program reads the same row from a workbook, is given
the same pulls, and has to find the same numbers to 0.1 %.

Axes: x downslope, y out of the ground, origin at the net's foot.
"""

import pytest

from netdesign.outcome import Verdict
from tests.checks.given_pulls import find_second, judge_row

SECOND = find_second(1.0)

CLOSE = {"rel": 1e-3}


def expect(check, *, demand, resistance, utilisation, verdict):
    assert check.demand_kN == pytest.approx(demand, **CLOSE)
    assert check.resistance_kN == pytest.approx(resistance, **CLOSE)
    assert check.utilisation == pytest.approx(utilisation, **CLOSE)
    assert check.verdict is verdict


def test_row_1_inside_the_row_with_tests_under_the_nf_style_profile():
    checks = judge_row(
        "nf-p-95-304-style",
        anchor={
            "kind": "bar",
            "bar_diameter": 28,
            "strength": 500,
            "test_count": 3,
            "pull_out": 270,
            "test_mean": 290,
        },
        foot=(20.0, 18.0),
        head=(5.0, -22.0),
        **{"gap": 0.5},
    )
    # Geometry (structure/THEORY.md): head (3 tan 30, 3) = (1.7321, 3); post base at
    # 1.7321 - 3 tan 15 = 0.9282; uphill anchor at -3.
    # Post, head to base: (-0.8038, -3) / 3.1058 = (-0.2588, -0.9659).
    # Uphill guy, head to anchor: (-4.7321, -3) / 5.6029 = (-0.8446, -0.5354).
    # End effect, recalled from UV-0704, A = 0.5 m, N = 1.2 (no slip: the least of its
    # tables): f_R = (0.92 + 0.65 * 1.2) 0.25 = 0.425, over 0.60 * 0.25 = 0.15 m;
    # edge 3.5 / 2 + 0.425 * 0.15 = 1.814 m < 3.5 m: a support inside governs.
    width = 3.5
    # Pull on the head: 3.5 (5, -22) = (17.5, -77) kN. Equilibrium of the head,
    #   -0.2588 C + 0.8446 T = 17.5,   -0.9659 C + 0.5354 T = -77,
    # determinant -0.2588 * 0.5354 + 0.8446 * 0.9659 = 0.6772:
    post = (17.5 * 0.53544 + 0.84458 * 77.0) / 0.67722  # 109.86 kN
    guy = (0.25882 * 77.0 + 0.96593 * 17.5) / 0.67722  # 54.39 kN
    assert (post, guy) == (
        pytest.approx(109.86, **CLOSE),
        pytest.approx(54.39, **CLOSE),
    )
    # Load along the row, 10 %: at the foot sqrt(1 + 0.01) = 1.00499. At the head S =
    # 0.1 sqrt(17.5^2 + 77^2) = 7.896 kN, in two guys splayed by 30 degrees. Downhill
    # guy, head to anchor (2.1962, -3) / 3.7179 = (0.5907, -0.8069); with |u x p| =
    # 0.6772 and |d x p| = 0.7794 kappa = 0.7794 / 1.4566 = 0.5351:
    # N = 54.39 / (2 * 0.86603) + 0.5351 * 7.896 / 0.5 = 31.40 + 8.45 = 39.85 kN.
    one_guy = guy / (2.0 * 0.86603) + 0.5351 * 7.896 / 0.5
    assert one_guy == pytest.approx(39.85, **CLOSE)
    # No tension of the guys is counted on: the post gets w S / tan 30 more, (S18), with
    # u.p = 0.8446 * 0.2588 + 0.5354 * 0.9659 = 0.7357, d.p = -0.5907 * 0.2588
    # + 0.8069 * 0.9659 = 0.6265, w = 0.5351 * 0.7357 + 0.4649 * 0.6265 = 0.6850.
    added = 0.6850 * 7.896 / 0.57735  # 9.368 kN
    base, post = 0.96593 * post + added, post + added
    lateral = 1.00499
    # Foot anchor: 3.5 * sqrt(20^2 + 18^2) = 94.18 kN; 1.5 times with lateral load.
    foot = 1.5 * 94.18 * lateral  # 141.97 kN
    # Tendon: pi/4 * 28^2 mm2 * 500 MPa = 307.9 kN; 1.15 * 1.3 = 1.495 (ONR 24810).
    expect(
        checks["foot_anchor.tendon"],
        demand=foot,
        resistance=307.88 / 1.495,
        utilisation=0.6894,
        verdict=Verdict.PASS,
    )
    # Pull-out, three tests (EN 1997-1 A.9: 1.20 on the mean, 1.05 on the least):
    # min(290 / 1.20, 270 / 1.05) = min(241.67, 257.14) = 241.67 kN; EN 1537: 1.35.
    expect(
        checks["foot_anchor.pull_out"],
        demand=foot,
        resistance=241.67 / 1.35,
        utilisation=0.7931,
        verdict=Verdict.PASS,
    )
    # Rope 20 mm: 0.356 * 20^2 * 1770 = 252.0 kN, clips 0.8: 201.6 kN; 1.5.
    expect(
        checks["uphill_guy.rope"],
        demand=1.5 * one_guy,
        resistance=201.64 / 1.5,
        utilisation=0.4447,
        verdict=Verdict.PASS,
    )
    # Post (EN 1993-1-1, 6.3.1.2): N_cr = pi^2 * 210 GPa * 318 cm4 / 3.1^2 = 685.8 kN,
    # lambda = sqrt(799.0 / 685.8) = 1.0794, Phi = 0.5 (1 + 0.49 * 0.8794 + 1.1651)
    # = 1.2980, chi = 1 / (1.2980 + sqrt(1.6848 - 1.1651)) = 0.4953: 395.7 kN; 1.05.
    expect(
        checks["post.compression"],
        demand=1.5 * post,
        resistance=395.7 / 1.05,
        utilisation=0.4746,
        verdict=Verdict.PASS,
    )
    # Base plate: 0.9659 * 109.86 + 9.368 = 115.5 kN across it. It bears
    # 0.6 * 0.5 * 2000 = 600 kN of a load across it; leaning uphill (EN 1997-1, D.4)
    # m = (2 + 5/6) / (1 + 5/6) = 1.5455, (1 - tan 15)^2.5455 = 0.73205^2.5455
    # = 0.45205: 271.2 kN typed; 1.4.
    expect(
        checks["post_base.bearing"],
        demand=1.5 * base,
        resistance=271.23 / 1.4,
        utilisation=0.8942,
        verdict=Verdict.PASS,
    )
    # Sliding: 115.5 tan 15 = 30.95 kN; 0.6 * 1.5 * 115.5 = 103.9 kN; 1.1.
    expect(
        checks["post_base.sliding"],
        demand=1.5 * 30.95,
        resistance=103.9 / 1.1,
        utilisation=0.4914,
        verdict=Verdict.PASS,
    )
    # Snow on the post, N = 1.2. Load case 1, no altitude, rho 1.3 * 0.27, of a net
    # full of snow, H_K = 3 / cos 35 = 3.6623 m: K = 0.7910 sin 70 = 0.7433,
    # S'_N = 0.5 * 3.51 * 13.412 * 0.7433 * 1.2 = 21.00 kN/m over 3 m: 6.998 kPa.
    # Load case 2, the same on 0.77 * 3 = 2.31 m: 9.089 kPa, the largest.
    # The densest snow, 380 kg/m3, as typed: K = 0.8114 sin 70 = 0.7625,
    # S'_N = 0.5 * 3.8 * 11.683 * 0.7625 * 1.2 = 20.31 kN/m over 2.8 m: 7.254 kPa.
    # M = 9.089 * 0.12 * 3.1^2 / 8 = 1.3102 kN m; gamma_E 1.5: 1.9652 kN m.
    # M_Rk = 144 cm3 * 235 = 33.84 kN m; m = 1.05 * 1.9652 / 33.84 = 0.06098.
    # (1 - 1.05 C / 395.7) (1 - C / 685.8) = 0.06098: C = 332.3 kN.
    expect(
        checks["post.compression_bending"],
        demand=1.5 * post,
        resistance=332.3,
        utilisation=0.5382,
        verdict=Verdict.PASS,
    )
    # The slack downhill guys: at most (1 - 0.5351 < 1/2) 0.5 * 7.896 / 0.5 = 7.896 kN.
    assert checks["downhill_guy.rope"].demand_kN == pytest.approx(11.844, **CLOSE)
    assert checks["post.lateral"].verdict is Verdict.PASS
    assert checks["foot_anchor.tendon"].position == "intermediate"
    inside = checks["foot_anchor.tendon"].read("E_s")  # a bay of it
    assert inside == pytest.approx(width * 26.907, **CLOSE)


def test_row_2_free_end_with_bond_under_the_swiss_profile():
    checks = judge_row(
        "swiss-guideline-2007",
        anchor={
            "kind": "bar",
            "bar_diameter": 32,
            "strength": 500,
            "pull_out": 152.68,
            "proven": "calculated",
            "ground": "gravel",
        },
        foot=(15.0, 12.0),
        head=(4.0, -15.0),
        **{"glide_factor": 2.0, "post_spacing": 4.0},
    )
    # No gap is given: a free end. f_R = 1.00 + 1.25 * 2.0 = 3.5 over D_K / 3 = 1.0 m:
    # edge 4 / 2 + 3.5 * 1.0 = 5.5 m > 4 m of those inside (all recalled, UV-0704).
    # Geometry as in row 1; head pull on 5.5 m: (22, -82.5) kN.
    post = (22.0 * 0.53544 + 0.84458 * 82.5) / 0.67722  # 120.28 kN
    guy = (0.25882 * 82.5 + 0.96593 * 22.0) / 0.67722  # 62.91 kN
    # Foot: 5.5 * sqrt(15^2 + 12^2) = 105.65 kN.
    foot = 1.5 * 105.65 * 1.00499  # 159.27 kN
    # Tendon pi/4 * 32^2 * 500 = 402.1 kN, 1.35 (recalled).
    expect(
        checks["foot_anchor.tendon.end"],
        demand=foot,
        resistance=402.12 / 1.35,
        utilisation=0.5347,
        verdict=Verdict.PASS,
    )
    # Bond: pi * 0.09 * 4.5 * 120 kPa (FHWA, gravel, type B, least) = 152.68 kN typed.
    # 1.35 * 1.40 * 1.25 = 2.3625: 64.63 kN.
    expect(
        checks["foot_anchor.pull_out.end"],
        demand=foot,
        resistance=152.68 / 2.3625,
        utilisation=2.4644,
        verdict=Verdict.FAIL,
    )
    # Head 5.5 m wide: S = 0.1 * 85.38 kN; geometry and kappa as in row 1.
    expect(
        checks["uphill_guy.rope.end"],
        demand=1.5 * (guy / (2.0 * 0.86603) + 0.5351 * 8.538 / 0.5),
        resistance=201.64 / 1.35,  # recalled factor of ropes
        utilisation=0.4565,
        verdict=Verdict.PASS,
    )
    expect(
        checks["post.compression.end"],
        # w as in row 1: 0.6850 * 8.538 / tan 30 = 10.13 kN more.
        demand=1.5 * (post + 0.6850 * 8.538 / 0.57735),
        resistance=395.7 / 1.05,
        utilisation=0.5191,
        verdict=Verdict.PASS,
    )
    end = checks["foot_anchor.pull_out.end"]
    assert (end.position, end.read("b_e")) == ("edge", pytest.approx(5.5))
    # Inside the row the same anchor carries 4 m: 4 / 5.5 of it.
    inside = checks["foot_anchor.pull_out"]
    assert inside.position == "intermediate"
    assert inside.demand_kN == pytest.approx(foot * 4.0 / 5.5, **CLOSE)
    assert inside.utilisation == pytest.approx(2.4644 * 4.0 / 5.5, **CLOSE)
    # Resistance that would do, for the pull-out: 159.27 * 2.3625 = 376.3 kN.
    needed = checks["foot_anchor.pull_out.end"].changes[0]
    assert needed.bound == pytest.approx(159.27 * 2.3625, **CLOSE)


def test_row_3_head_drawn_upslope_under_the_onr_style_profile():
    checks = judge_row(
        "onr-24805-style",
        anchor={
            "kind": "bar",
            "bar_diameter": 25,
            "strength": 500,
            "test_count": 1,
            "pull_out": 180,
            "test_mean": 180,
        },
        foot=(18.0, 20.0),
        head=(-12.0, -20.0),
        **{"gap": 1.0},
    )
    # Head pull on 3.5 m: (-42, -70) kN, upslope of the post: the uphill guy is slack.
    # Downhill guy: anchor at 0.9282 + 3 = 3.9282; head to anchor (2.1962, -3) / 3.7179
    # = (0.5907, -0.8069). Equilibrium:
    #   -0.2588 C - 0.5907 T = -42,   -0.9659 C + 0.8069 T = -70,
    # determinant -0.2588 * 0.8069 - 0.5907 * 0.9659 = -0.7794:
    post = (-42.0 * 0.80692 - 0.59070 * 70.0) / -0.77942  # 96.53 kN
    guy = (0.25882 * 70.0 - 0.96593 * 42.0) / -0.77942  # 28.81 kN
    assert (post, guy) == (pytest.approx(96.53, **CLOSE), pytest.approx(28.81, **CLOSE))
    # Beside the end f_R l^2 / (2 b) = 0.85 * 0.09 / 7 = 0.0109 m more, 0.312 %.
    assert pytest.approx(1.00312, abs=5e-6) == SECOND
    # S = 0.1 * 81.63 kN; the uphill guys have at most 0.5351 * 8.163 / 0.5 = 8.736 kN.
    slack = 13.104 * SECOND
    assert checks["uphill_guy.rope"].demand_kN == pytest.approx(slack, **CLOSE)
    assert checks["uphill_guy.rope"].verdict is Verdict.PASS
    one_guy = guy / (2.0 * 0.86603) + 0.5 * 8.163 / 0.5  # 24.80 kN
    # w as in row 1: 0.6850 * 8.163 / tan 30 = 9.685 kN more in the post.
    post += 0.6850 * 8.163 / 0.57735
    one_guy, post = one_guy * SECOND, post * SECOND
    # Gap 1 m, N = 1.2: f_R = 1.7 * 0.5 = 0.85 over 0.3 m, edge 2.005 m < 3.5 m.
    # Foot: 3.5 * sqrt(18^2 + 20^2) = 94.18 kN.
    foot = 1.5 * 94.18 * 1.00499 * SECOND
    # Tendon pi/4 * 25^2 * 500 = 245.4 kN over 1.495; ONR 24810, classes 1 and 2.
    expect(
        checks["foot_anchor.tendon"],
        demand=foot,
        resistance=245.44 / 1.495,
        utilisation=0.8648 * SECOND,
        verdict=Verdict.PASS,
    )
    # One test: 180 / 1.40 = 128.57 kN (EN 1997-1 A.9), over 1.2: 107.14 kN.
    expect(
        checks["foot_anchor.pull_out"],
        demand=foot,
        resistance=128.57 / 1.2,
        utilisation=1.3251 * SECOND,
        verdict=Verdict.FAIL,
    )
    expect(
        checks["downhill_guy.rope"],
        demand=1.5 * one_guy,
        resistance=201.64 / 1.5,
        utilisation=0.2767 * SECOND,
        verdict=Verdict.PASS,
    )
    expect(
        checks["downhill_anchor.pull_out"],
        demand=1.5 * one_guy,
        resistance=128.57 / 1.2,
        utilisation=0.3472 * SECOND,
        verdict=Verdict.PASS,
    )
    # Post over gamma_M1 = 1.1.
    expect(
        checks["post.compression"],
        demand=1.5 * post,
        resistance=395.7 / 1.1,
        utilisation=0.4429 * SECOND,
        verdict=Verdict.PASS,
    )
    # Tests needed: R_d = 142.42 kN wants R_k = 170.9 kN.
    needed = checks["foot_anchor.pull_out"].changes[0]
    assert needed.bound == pytest.approx(foot * 1.2, **CLOSE)
