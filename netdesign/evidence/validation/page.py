"""The page of ``netdesign validate``: verification, settling, measured structures."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from netdesign import __version__
from netdesign.evidence.table import (
    NUMBER_TEXTS,
    PAIRS,
    RANGES,
    TEXTS,
    numbers,
    tabulate_items,
)
from netdesign.evidence.validation.pictures import (
    draw_bands,
    draw_compaction,
    draw_errors,
    draw_reach,
    name_validated,
)
from netdesign.evidence.validation.reach import (
    HEIGHT,
    SLOPE,
    Reach,
    find_reaches,
)
from netdesign.evidence.validation.reach import MARKS as REACH_MARKS
from netdesign.evidence.validation.structure import (
    Measurement,
    MemberBand,
    Span,
    Structure,
    Validation,
    validate_structure,
)
from netdesign.evidence.validation.variants import AS_GIVEN, Variant, examine
from netdesign.evidence.verification.case import MARKS, VerificationCase
from netdesign.evidence.verification.compaction import (
    MODELS,
    PLACE,
    Contrast,
    Place,
    compare_contrasts,
    compute_viscosity,
    find_middle,
    list_growth,
    list_places,
)
from netdesign.evidence.verification.exported import (
    list_files,
    load_results,
    solve_exported,
    write_scenes,
)
from netdesign.evidence.verification.pack import GROUPS, name_kind, run_pack, write_pack
from netdesign.report.blocks import (
    CODE,
    Block,
    Figure,
    Heading,
    Items,
    Paragraph,
    Part,
    Piece,
    Table,
    masthead,
    section,
)
from netdesign.report.page.render import render_page
from netdesign.report.words import MISSING, Words, show_own
from netdesign.snow.creep_law import BOUTILLIER_2004, ZWINGER_2007
from netdesign.words.catalogue import Language
from netdesign.words.message import say

PAGE_FILE, DOCUMENT_FILE = "validation.html", "validation.json"
_GROUNDS = {"no-slip": "validation.no_slip", "free": "validation.free"}
_LAYERS = {"first": 0.8, "second": 1.0, "third": 1.2}  # of the layered scene [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Evidence:
    """Everything that the page shows."""

    cases: Sequence[VerificationCase]
    places: Sequence[Place]
    contrasts: Sequence[Contrast]
    validations: Sequence[Validation]
    reaches: Sequence[Reach]
    variants: Sequence[Variant] = ()


def render_validation(
    evidence: Evidence, language: Language = "en"
) -> dict[str, bytes]:
    """Page and document, by the names of their files.

    Parameters
    ----------
    evidence : Evidence
        As computed.
    language : str
        Of the page.
    """
    return {
        PAGE_FILE: _render_page(evidence, Words(language)).encode(),
        DOCUMENT_FILE: json.dumps(
            write_evidence(evidence), indent=1, allow_nan=False
        ).encode(),
    }


def _render_page(evidence: Evidence, words: Words) -> str:
    first = masthead(
        f"netdesign validate · {__version__}",
        words("validation.heading"),
        Paragraph(text=_lead(evidence, words), look="lead"),
    )
    blocks: list[Block] = [first, _list_marks(words)]
    if evidence.validations:
        blocks.append(_show_structures(evidence.validations, words))
    if evidence.variants:
        blocks.append(_show_variants(evidence.variants, words))
    blocks += [
        _show_reaches(evidence.reaches, words),
        _show_settling(evidence, words),
        _show_cases(evidence.cases, words),
    ]
    return render_page(blocks, words("validation.title"), words.language)


def _lead(evidence: Evidence, words: Words) -> str:
    passed = sum(case.passes for case in evidence.cases)
    told = words("validation.lead", passed=passed, count=len(evidence.cases))
    compared = [c for one in evidence.validations for c in one.comparisons]
    if not compared:
        return told
    measured = words(
        "validation.lead_measured",
        measured=len(compared),
        inside=sum(one.is_inside for one in compared),
        middle=sum(one.is_in_the_middle for one in compared),
    )
    return f"{told} {measured}"


def _text(words: Words, key: str, more: str = "", **numbers: Any) -> Paragraph:
    return Paragraph(text=words(f"validation.{key}", **numbers) + more, look="text")


def _plate(name: str, svg: str, words: Words) -> Figure:
    caption = words(f"validation.{name}_caption")
    return Figure(svg=svg, caption=caption, id=f"plate-{name}", look="plate")


def _list_marks(words: Words) -> Part:
    """Meaning of each mark of an expected value."""
    meant = [(_mark(one, words), one) for one in MARKS]
    unknown = f"{_mark('assumed', words)}, {_mark('unknown', words)}"
    items = tuple(
        words("show.label", label=label, text=words(f"validation.{one}_means"))
        for label, one in (*meant, (unknown, "unknown"))
    )
    return section("marks", words("validation.marks"), Items(items=items))


def _show_structures(validations: Sequence[Validation], words: Words) -> Part:
    owner = words("validation.owner")
    command = Piece("netdesign validate FILE.toml --out DIR", CODE)
    return section(
        "structures",
        words("validation.structures"),
        _text(words, "structures_text"),
        _plate("bands", draw_bands(validations, words), words),
        *(block for one in validations for block in _show_structure(one, words)),
        Paragraph(text=(Piece(f"{owner} "), command), look="text"),
        look="page",
    )


def _show_variants(variants: Sequence[Variant], words: Words) -> Part:
    """Two forces below the model's, with one thing changed at a time."""
    columns = {
        "validation.measured": (TEXTS, lambda one: _name_force(one, words)),
        "kN": (
            NUMBER_TEXTS,
            lambda one: _show_measured(one.comparison.measured, words),
        ),
        "validation.changed": (TEXTS, lambda one: words(f"variant.{one.name}")),
        "validation.middle": (RANGES, lambda one: one.comparison.bands[0].middle),
        "validation.below_share": (
            numbers(".0f"),
            lambda one: 100.0 * one.comparison.bands[0].share_below,
        ),
        "validation.others": (NUMBER_TEXTS, lambda one: _count_others(one, words)),
        "validation.explains": (
            TEXTS,
            lambda one: words("validation.yes" if one.explains else "validation.no"),
        ),
    }
    changed = [one for one in variants if one.name != AS_GIVEN]
    explained, left = (
        tuple(
            words(
                "show.label",
                label=show_own(words, one.structure.title),
                text=words(f"variant.{one.name}"),
            )
            for one in changed
            if one.explains is is_explained
        )
        for is_explained in (True, False)
    )
    return section(
        "variants",
        words("validation.variants"),
        _text(words, "variants_text"),
        tabulate_items("", columns, variants, words).shown("study"),
        _text(words, "variants_answer", explained=explained, left=left),
        look="page",
    )


def _count_others(one: Variant, words: Words) -> str:
    """Other forces of the structure that four of five cases of the variant hold."""
    if not one.others:
        return MISSING
    inside = sum(other.is_in_the_middle for other in one.others)
    return words("validation.of", part=inside, count=len(one.others))


def _name_force(one: Variant, words: Words) -> str:
    return words(
        "show.label",
        label=show_own(words, one.structure.title),
        text=show_own(words, one.comparison.measured.name),
    )


def _show_reaches(reaches: Sequence[Reach], words: Words) -> Part:
    """Glide upslope of a net, beside what glide shoes and the guideline say."""
    near, far = REACH_MARKS[1], REACH_MARKS[2]
    first, last = reaches[0], reaches[-1]
    return section(
        "reach",
        words("validation.reach"),
        _text(words, "reach_text", height=HEIGHT, slope=SLOPE),
        _plate("reach", draw_reach(reaches, words), words),
        _tabulate_reaches(reaches, words).shown("study"),
        _text(
            words,
            "reach_answer",
            distance=near,
            least=1.0 - first.find(near)[1],
            most=1.0 - last.find(near)[1],
            little=first.glide_factor,
            much=last.glide_factor,
        ),
        _text(
            words,
            "reach_of_row",
            least=1.0 - first.find(far)[0],
            most=1.0 - last.find(far)[0],
        ),
        look="page",
    )


def _tabulate_reaches(reaches: Sequence[Reach], words: Words) -> Table:
    """Glide at the marks, of row and net, in per cent of the glide without a net."""
    columns: dict[str, Any] = {"N": (numbers(".1f"), lambda one: one.glide_factor)}
    for place, name in enumerate(("of_row", "of_net")):
        for mark in REACH_MARKS:
            heading = words(
                "validation.at_mark", what=words(f"validation.{name}"), at=mark
            )
            columns[heading] = (numbers(".0f"), _take_share(place, mark))
    return tabulate_items(words("validation.reach_table"), columns, reaches, words)


def _take_share(place: int, mark: float) -> Callable[[Reach], float]:
    return lambda one: 100.0 * one.find(mark)[place]


def _show_settling(evidence: Evidence, words: Words) -> Part:
    growth: dict[str, Any] = {key: f"{one:.0f}" for key, one in list_growth().items()}
    layers = say("validation.layers", **_LAYERS)
    return section(
        "settling",
        words("validation.settling"),
        _text(words, "settling_text", f" {_list_models(words)}."),
        _plate("compaction", draw_compaction(evidence.places, words), words),
        _text(words, "quoted", **_quote(words)),
        Heading(text=words("validation.meaning"), level=3),
        _text(words, "meaning_text", layers=layers, **growth),
        _tabulate_contrasts(evidence.contrasts, words).shown("study"),
        _text(words, "uniform_text"),
        look="page",
    )


def _show_cases(cases: Sequence[VerificationCase], words: Words) -> Part:
    return section(
        "verification",
        words("validation.verification"),
        _plate("errors", draw_errors(cases, words), words),
        Heading(text=words("validation.another"), level=3),
        _text(words, "another_text"),
        Items(items=tuple(_list_codes(words)), look="small"),
        _tabulate_cases(cases, words).shown("study pack"),
        look="page",
    )


def _quote(words: Words) -> dict[str, str]:
    """Viscosity at one place by two of the laws, over the middle of the models."""
    density, stress = PLACE
    middle = find_middle(density)
    found = {
        key: compute_viscosity(law, density, stress)
        for key, law in (("own", BOUTILLIER_2004), ("stiffest", ZWINGER_2007))
    }
    return {
        "density": words.write(f"{density:g}"),
        "stress": words.write(f"{stress / 1e3:g}"),
        "value": words.write(f"{found['own']:.2g}"),
        **{key: words.write(f"{value / middle:.1f}") for key, value in found.items()},
    }


def _tabulate_cases(cases: Sequence[VerificationCase], words: Words) -> Table:
    fails = words("validation.fails")
    columns = {
        "verify_table.id": (TEXTS, lambda one: one.id),
        "verify_table.kind": (TEXTS, lambda one: name_kind(one.kind, words)),
        "verify_table.reference": (
            TEXTS,
            lambda one: words(f"reference.{one.reference}"),
        ),
        "validation.reference_is": (TEXTS, lambda one: _mark(one.mark, words)),
        "verify_table.expected": (numbers(".5g"), lambda one: one.expected),
        "validation.computed": (numbers(".5g"), lambda one: one.got),
        "verify_table.error": (numbers(".1e"), lambda one: one.error),
        "validation.tolerance": (numbers(".1e"), lambda one: one.tolerance),
        "verify_table.order": (numbers(".2f"), lambda one: one.order),
        "validation.passes": (TEXTS, lambda one: "✓" if one.passes else fails),
    }
    return tabulate_items("", columns, cases, words)


def _mark(mark: str, words: Words) -> str:
    return words(f"validation_mark.{mark}")


def _list_models(words: Words) -> str:
    """Models of settling, each with its source and mark."""
    mark = words("validation_mark.read")
    return words.join(
        f"{one.name} ({show_own(words, one.source)}, {mark})" for one in MODELS
    )


def _list_codes(words: Words) -> list[str]:
    """Other codes, each with its scenes and its recipe."""
    codes: dict[tuple[str, str], list[str]] = {}
    for one in load_results():
        codes.setdefault((one.code, one.recipe), []).append(one.scene)
    return [
        words(
            "validation.code",
            name=show_own(words, name),
            scenes=", ".join(scenes),
            recipe=show_own(words, recipe),
        )
        for (name, recipe), scenes in codes.items()
    ]


def _tabulate_contrasts(contrasts: Sequence[Contrast], words: Words) -> Table:
    columns = {
        "validation.ground": (TEXTS, lambda one: words(_GROUNDS[one.ground])),
        "validation.own_law": (PAIRS, lambda one: one.own_N_m),
        "validation.other_law": (PAIRS, lambda one: one.other_N_m),
        "validation.change": (NUMBER_TEXTS, _show_change),
        "validation.uniform": (PAIRS, lambda one: one.uniform_N_m),
    }
    return tabulate_items(
        words("validation.contrast_caption"), columns, contrasts, words
    )


def _show_change(one: Contrast) -> str:
    pairs = zip(one.own_N_m, one.other_N_m, strict=True)
    return " / ".join(f"{100 * (other / own - 1):+.0f}" for own, other in pairs)


def _show_structure(one: Validation, words: Words) -> Iterator[Block]:
    structure = one.structure
    counts: dict[str, Any] = {"count": one.solved}
    if one.failed:
        counts |= {"failed": one.failed, "reasons": tuple(map(str, one.reasons))}
    key = "validation.cases_failed" if one.failed else "validation.cases"
    source, note = show_own(words, structure.source), _tell(structure.note, words)
    yield Heading(text=show_own(words, structure.title), level=3)
    told = f"{source}. {note} {words(key, **counts)}."
    yield Paragraph(text=told, look="small")
    yield _tabulate_measured(one, words).shown("study")
    yield Part(
        kind="div",
        fold=words("validation.inputs"),
        blocks=(_tabulate_inputs(structure, words).shown("study"),),
    )
    if structure.open:
        label = words("show.label", label=words("validation.open"), text="")
        yield Paragraph(text=label, look="small")
        yield Items(
            items=tuple(show_own(words, text) for text in structure.open), look="small"
        )


def _tabulate_measured(one: Validation, words: Words) -> Table:
    computed = "validation.computed" if one.structure.is_known else "validation.band"
    columns = {
        "validation.measured": (TEXTS, lambda at: _name_measured(at[0], words)),
        "kN": (NUMBER_TEXTS, lambda at: _show_measured(at[0], words)),
        "validation.mark": (TEXTS, lambda at: _mark(at[0].mark, words)),
        "validation.member": (TEXTS, lambda at: name_validated(at[1].member, words)),
        computed: (RANGES, lambda at: (at[1].low, at[1].high)),
        "validation.middle": (RANGES, lambda at: at[1].middle),
        "validation.numerical": (
            numbers(".1f"),
            lambda at: 100 * at[1].numerical_error,
        ),
        "validation.value": (TEXTS, lambda at: _judge_band(at[0], at[1], one, words)),
    }
    bands = [(pair.measured, band) for pair in one.comparisons for band in pair.bands]
    return tabulate_items("", columns, bands, words)


def _name_measured(measured: Measurement, words: Words) -> str:
    name = show_own(words, measured.name)
    if not measured.note:
        return name
    return words("show.label", label=name, text=_tell(measured.note, words))


def _show_measured(measured: Measurement, words: Words) -> str:
    uncertain = f" ± {measured.uncertainty:g}" if measured.uncertainty else ""
    return words.write(f"{measured.value:g}{uncertain}")


def _judge_band(
    measured: Measurement, band: MemberBand, one: Validation, words: Words
) -> str:
    if one.structure.is_known:
        misfit = 100.0 * (band.low / measured.value - 1.0)
        return words("validation.misfit", misfit=misfit)
    share = 100.0 * band.share_below
    return words(f"validation.{band.place(measured)}", share=share)


def _tabulate_inputs(structure: Structure, words: Words) -> Table:
    columns = {
        "validation.input": (TEXTS, lambda one: words(f"validation_input.{one[0]}")),
        "validation.range": (TEXTS, lambda one: _show_span(one[1], words)),
        "validation.mark": (TEXTS, lambda one: _mark(one[1].mark, words)),
        "validation.reason": (TEXTS, lambda one: _tell(one[1].reason, words)),
    }
    return tabulate_items("", columns, structure.inputs.items(), words)


def _show_span(span: Span, words: Words) -> str:
    low, high = words.show_given(span.low), words.show_given(span.high)
    return low if span.is_known else words("show.band", low=low, high=high)


def _tell(text: str, words: Words) -> str:
    """Text of a structure, which may have none."""
    return show_own(words, text) if text else ""


def write_evidence(evidence: Evidence) -> dict[str, Any]:
    """Plain values of the page in the form ``netdesign.validation/1``."""
    return {
        "schema": "netdesign.validation/1",
        "version": __version__,
        "verification": write_pack(list(evidence.cases))["cases"],
        "compaction": [asdict(one) for one in evidence.places],
        "contrasts": [asdict(one) for one in evidence.contrasts],
        "reach": [asdict(one) for one in evidence.reaches],
        "variants": [_write_variant(one) for one in evidence.variants],
        "structures": [_write_structure(one) for one in evidence.validations],
    }


def _write_variant(one: Variant) -> dict[str, Any]:
    return {
        "structure": one.structure.id,
        "changed": one.name,
        "measured_kN": one.comparison.measured.value,
        "explains": one.explains,
        "others_inside": [other.is_in_the_middle for other in one.others],
        "bands": [asdict(band) for band in one.comparison.bands],
    }


def _write_structure(one: Validation) -> dict[str, Any]:
    return {
        **asdict(one.structure),
        "is_known": one.structure.is_known,
        "solved": one.solved,
        "failed": one.failed,
        "reasons": list(one.reasons),
        "measured": [
            {
                **asdict(comparison.measured),
                "is_inside": comparison.is_inside,
                "is_in_the_middle": comparison.is_in_the_middle,
                "bands": [asdict(band) for band in comparison.bands],
            }
            for comparison in one.comparisons
        ],
    }


def list_pages() -> list[str]:
    """Names of the page's files, the page first; then those of the scenes."""
    return [PAGE_FILE, DOCUMENT_FILE, *list_files()]


def render_pages(evidence: Evidence, language: Language = "en") -> dict[str, bytes]:
    """Page, its document and the exported scenes, by the names of their files."""
    return render_validation(evidence, language) | write_scenes(solve_exported())


def count_parts(structures: Sequence[Structure]) -> int:
    """Parts that ``gather`` tells of."""
    return len(GROUPS) + len(structures)


def gather(
    structures: Sequence[Structure],
    advance: Callable[[int], None] | None = None,
    cases: Sequence[VerificationCase] | None = None,
) -> Evidence:
    """Run the pack, the settling of snow, and every structure.

    Parameters
    ----------
    structures : sequence of Structure
        As read.
    advance : callable, optional
        Told how many parts are done.
    cases : sequence of VerificationCase, optional
        Of the pack, where it has been run already.
    """
    cases = run_pack(advance) if cases is None else cases
    validations = []
    for done, structure in enumerate(structures, start=len(GROUPS) + 1):
        validations.append(validate_structure(structure))
        if advance:
            advance(done)
    return Evidence(
        cases=cases,
        places=list_places(),
        contrasts=compare_contrasts(),
        validations=validations,
        reaches=find_reaches(),
        variants=examine(structures),
    )
