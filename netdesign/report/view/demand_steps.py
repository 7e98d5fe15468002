"""Steps from a solved force to the demand of a check, in symbols and in numbers."""

from __future__ import annotations

from netdesign.report.words import Words, show_text
from netdesign.structure.members import ROPE_OF
from netdesign.study.records import ActionRecord, CheckRecord
from netdesign.words.names import name


def describe_widths(
    check: CheckRecord, words: Words
) -> tuple[tuple[str, str, str], ...]:
    """Steps from the solved force to the characteristic action of a support."""
    action = check.action
    if action is None:
        return ()
    steps = []
    is_of_rope = check.member in ROPE_OF
    if action.position == "edge":
        bay, half = ("b", "") if is_of_rope else ("b / 2", " / 2")
        length = "Δl"
        reach = action.end_length_m
        if is_of_rope and reach > action.post_spacing_m / 2.0:
            length, reach = "b", action.post_spacing_m
        spacing = words.show_with_unit("post_spacing_m", action.post_spacing_m)
        factor = words.show_with_unit("end_factor", action.end_factor)
        reached = words.show_with_unit("end_length_m", reach)
        shown = words.show_with_unit("loaded_width_m", action.loaded_width_m)
        numbers = f"{spacing}{half} + {factor} · {reached}"
        steps.append((f"b_e = {bay} + f_R · {length}", numbers, shown))
    steps += _describe_parts(words, action)
    if check.mode == "sliding":  # both parts of the post's force on the ground
        tilt = words.show_with_unit("share", action.share)
        steps.append(("g", "|F_x / F_y|", tilt))
    solved = words.show_with_unit("solved_kN", action.solved_kN)
    if action.floor_kN is None and action.panel_kN is None:
        force = words.show_with_unit("action_kN", check.action_kN)
        symbols, numbers = _load_member(words, "E_s", solved, action)
        line = (
            f"E_k = {symbols} · b_e / b · k_q",
            _widen(words, numbers, action),
            force,
        )
        steps.append(line)
    else:
        steps += _describe_floor(words, check, action, solved)
    if action.other_width_m is not None and check.action_kN is not None:
        other = check.action_kN * action.other_width_m / action.loaded_width_m
        width, taken = (
            words.show_with_unit("loaded_width_m", one)
            for one in (action.other_width_m, action.loaded_width_m)
        )
        force = words.show_with_unit("action_kN", check.action_kN)
        numbers = f"{force} · {width} / {taken}"
        shown = words.show_with_unit("action_kN", other)
        steps.append(("E_k' = E_k · b_e' / b_e", numbers, shown))
    return tuple(steps)


def _describe_parts(words: Words, action: ActionRecord) -> list[tuple[str, str, str]]:
    """Sum of two members on one anchor; what the load along the row adds."""
    steps = []
    if action.foot_part_kN is not None and action.guy_part_kN is not None:
        parts = (
            words.show_with_unit("solved_kN", one)
            for one in (action.foot_part_kN, action.guy_part_kN)
        )
        solved = words.show_with_unit("solved_kN", action.larger_force)
        symbol = "E_p" if action.is_by_panel else "E_s"
        symbols = f"{symbol} = |F_f| + T_u"
        steps.append((symbols, " + ".join(parts), solved))
    load = action.sideways
    if load is None:
        return steps
    part, share, pull, splay, tension = (
        words.show_with_unit(key, getattr(load, key))
        for key in ("part", "share", "pull_kN", "splay_deg", "least_tension_kN")
    )
    added = words.show_with_unit("added_kN", action.added_kN)
    if load.least_tension_kN is None:
        symbols = "g = 1 / (2 cos β), A = c · k · P / sin β"
        numbers = f"{part} · {share} · {pull} / sin {splay}"
    else:
        symbols = "A = w · (k · P / tan β − T_min)"
        numbers = f"{part} · ({share} · {pull} / tan {splay} − {tension})"
    return [*steps, (symbols, numbers, added)]


def _load_member(
    words: Words, symbol: str, force: str, action: ActionRecord
) -> tuple[str, str]:
    """Force of the section with its share and what is added, symbols and numbers."""
    if action.share == 1.0 and not action.added_kN:
        return symbol, force
    share, added = (
        words.show_with_unit(key, getattr(action, key)) for key in ("share", "added_kN")
    )
    return f"(g · {symbol} + A)", f"({share} · {force} + {added})"


def _describe_floor(
    words: Words, check: CheckRecord, action: ActionRecord, solved: str
) -> list[tuple[str, str, str]]:
    """Forces by section, panel and guideline, of which the largest one counts."""
    coupled = words.show_with_unit("coupled_kN", action.section_force)
    found = [("E_c", "E_s", solved, coupled)]
    if action.panel_kN is not None:
        inside = words.show_with_unit("panel_kN", action.panel_kN)
        shown = words.show_with_unit("panel_support_kN", action.panel_force)
        found.append(("E_p", "E_p0", inside, shown))
    if action.floor_kN is not None:
        floor = words.show_with_unit("floor_kN", action.floor_kN)
        least = words.show_with_unit("guideline_kN", action.guideline_kN)
        found.append(("E_g", "E_g0", floor, least))
    steps = []
    for symbol, inside_symbol, inside, shown in found:
        symbols, numbers = _load_member(words, inside_symbol, inside, action)
        symbols, numbers = f"{symbols} · b_e / b · k_q", _widen(words, numbers, action)
        if symbol == "E_p" and action.along_kN:
            symbols += " + H · tan γ"
            numbers += f" + {words.show_with_unit('along_kN', action.along_kN)}"
        steps.append((f"{symbol} = {symbols}", numbers, shown))
    largest = "; ".join(symbol for symbol, *_ in found)
    numbers = "; ".join(shown for *_, shown in found)
    force = words.show_with_unit("action_kN", check.action_kN)
    return [*steps, (f"E_k = max({largest})", f"max({numbers})", force)]


def _widen(words: Words, force: str, action: ActionRecord) -> str:
    return (
        f"{force} · {words.show_with_unit('loaded_width_m', action.loaded_width_m)} / "
        f"{words.show_with_unit('post_spacing_m', action.post_spacing_m)} · "
        f"{words.show_with_unit('lateral_factor', action.lateral_factor)}"
    )


def describe_load(check: CheckRecord, words: Words) -> str:
    """Governing load of a demand, with all values; "" where there is one alone."""
    action = _find_loaded(check)
    if action is None:
        return ""
    told = [] if action.panel_kN is None else [_describe_panel(action, words)]
    if action.guideline_kN is not None:
        first = "guideline" if action.governs == "guideline" else "coupled"
        pair = words(
            f"show.load_{first}",
            coupled=words.show_with_unit("coupled_kN", action.coupled_kN),
            guideline=words.show_with_unit("guideline_kN", action.guideline_kN),
            case=show_text(words.show(name("load_case", action.floor_case))),
        )
        told.insert(0 if action.governs != "panel" else 1, pair)
    return words.join(told)


def _describe_panel(action: ActionRecord, words: Words) -> str:
    panel = words.show_with_unit("panel_support_kN", action.panel_support_kN)
    coupled = words.show_with_unit("coupled_kN", action.coupled_kN)
    return words("show.load_panel", panel=panel, coupled=coupled)


def show_loads(check: CheckRecord, words: Words) -> str:
    """All values by their symbols, characteristic, the one that governs first.

    Returns "" where there is one alone.
    """
    action = _find_loaded(check)
    if action is None:
        return ""
    loads = (
        ("coupled", "E_c", "coupled_kN", action.coupled_kN),
        ("panel", "E_p", "panel_support_kN", action.panel_support_kN),
        ("guideline", "E_g", "guideline_kN", action.guideline_kN),
    )
    values = {
        load: f"{symbol} {words.show_number(key, value)}"
        for load, symbol, key, value in loads
        if value is not None or load == "coupled"
    }
    first = values.pop(action.governs or "coupled")
    return words.join([first, *values.values()])


def _find_loaded(check: CheckRecord) -> ActionRecord | None:
    """Action under several loads; None of one alone, and of a slack member."""
    action = check.action
    if action is None:
        return None
    beside = (action.guideline_kN, action.panel_support_kN)
    if beside == (None, None):
        return None
    return action if action.coupled_kN or any(beside) else None
