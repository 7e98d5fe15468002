"""Standard streams that survive what stands at their other end.

A reader may stop (``netdesign check site.xlsx | head``), a disk be full, a code page
lack the signs of a table. None of that changes a verdict, and none may look like one:
a run goes on to its end, and what could not be written is told by ``fault``.
"""

from __future__ import annotations

import codecs
import io
import sys
import unicodedata

_PLAIN = "netdesign.plain"  # the handler of signs that a code page lacks
_SPELLED = {
    **{"α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "η": "eta"},
    **{"λ": "lambda", "⁻": "-"},
    **{"θ": "theta", "μ": "mu", "π": "pi", "ρ": "rho", "σ": "sigma", "τ": "tau"},
    **{"φ": "phi", "ψ": "psi", "Δ": "Delta", "Σ": "Sigma"},
    **{"·": "*", "×": "x", "−": "-", "–": "-", "—": "-", "→": "->", "›": ">"},
    **{"‹": "<", "«": '"', "»": '"', "„": '"', "“": '"', "”": '"', "’": "'"},
    **{
        "‘": "'",
        "≤": "<=",
        "≥": ">=",
        "≈": "~",
        "±": "+/-",
        "°": " deg",
        "√": "sqrt",
        "∞": "inf",
    },
    **{"…": "...", "•": "*", "ß": "ss", "Æ": "AE", "æ": "ae", "Ø": "O", "ø": "o"},
    **{"œ": "oe", "Œ": "OE", "✓": "(v)", "✗": "(x)", "†": "(+)", "‡": "(++)"},
}


class _Lasting(io.RawIOBase):
    """A stream that goes on in silence once it can no longer be written to.

    ``fault`` is the reason why it is not complete; a reader who stopped is none.
    """

    def __init__(self, raw: io.RawIOBase) -> None:
        self._raw = raw
        self._is_lost = False
        self.fault: OSError | None = None

    def write(self, data: object, /) -> int | None:
        """Write, or drop what nobody can take."""
        if not self._is_lost:
            try:
                return self._raw.write(data)  # type: ignore[arg-type]
            except BrokenPipeError:
                self._is_lost = True  # whoever read has seen enough
            except OSError as error:
                self._is_lost, self.fault = True, error
        return memoryview(data).nbytes  # type: ignore[arg-type]

    def writable(self) -> bool:
        """True, as for every output."""
        return True

    def fileno(self) -> int:
        """Descriptor of the stream below."""
        return self._raw.fileno()

    def isatty(self) -> bool:
        """True where the stream below is a terminal."""
        return self._raw.isatty()


def guard_streams() -> _Lasting | None:
    """Put lasting streams in the place of this process's own.

    Returns
    -------
    _Lasting or None
        Standard output; None where somebody else made it.
    """
    codecs.register_error(_PLAIN, _spell)
    _guard("stderr")
    return _guard("stdout")


def flush_streams() -> None:
    """Write what is left; afterwards the fault of a lasting stream is final."""
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.flush()


def _guard(name: str) -> _Lasting | None:
    stream = getattr(sys, name)
    if stream is not getattr(sys, f"__{name}__") or not isinstance(
        stream, io.TextIOWrapper
    ):
        return None
    buffer = stream.buffer
    raw: io.RawIOBase = getattr(buffer, "raw", buffer)  # type: ignore[assignment]
    lasting = _Lasting(raw)
    guarded = io.TextIOWrapper(
        io.BufferedWriter(lasting),
        encoding=stream.encoding,
        errors=_PLAIN,
        line_buffering=stream.line_buffering or name == "stderr",
        write_through=stream.write_through,
    )
    setattr(sys, name, guarded)
    return lasting


def _spell(error: UnicodeError) -> tuple[str, int]:
    """Spell in ASCII what an encoding lacks: ``φ`` as phi, ``é`` as e."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    text = error.object[error.start : error.end]
    return "".join(map(_spell_sign, text)), error.end


def _spell_sign(sign: str) -> str:
    if sign in _SPELLED:
        return _SPELLED[sign]
    decomposed = unicodedata.normalize("NFKD", sign)
    return "".join(letter for letter in decomposed if letter.isascii()) or "?"


def print_json(text: str) -> None:
    """Print a document in UTF-8, whatever the code page: its texts are data."""
    stream = sys.stdout
    if stream is None:
        return
    stream.flush()
    buffer = getattr(stream, "buffer", None)
    if buffer is None:
        stream.write(f"{text}\n")
    else:
        buffer.write(f"{text}\n".encode())
    stream.flush()
