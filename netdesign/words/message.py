"""A text as data: key and arguments, rendered in a language where it is shown."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

if TYPE_CHECKING:
    from pydantic_core import CoreSchema


Argument: TypeAlias = "str | int | float | Message | tuple[str | Message, ...]"


@dataclass(frozen=True, slots=True)
class Message:
    """Text for the user, in no language yet.

    Attributes
    ----------
    key : str
        Key of the text in ``words/LANGUAGE/AREA.toml``, as ``check.no_resistance``.
    arguments : mapping of str to Argument
        What stands in the gaps of the text. Somebody's own words are ``str``; words of
        ours are a `Message`, rendered in the same language; a tuple is a list of both.

    Examples
    --------
    >>> str(say("unit.count_cases", count=3))
    '3 cases'
    """

    key: str
    arguments: Mapping[str, Argument] = field(
        default_factory=lambda: MappingProxyType({})
    )

    def __str__(self) -> str:
        """Text in English, for logs and for use from Python."""
        from netdesign.words.catalogue import render

        return render(self, "en")

    def __hash__(self) -> int:
        return hash((self.key, frozenset(self.arguments.items())))

    def __reduce__(self) -> tuple[object, ...]:
        """The plain values: a mapping that cannot be changed is not pickled."""
        return _restore, (self.key, dict(self.arguments))


def say(key: str, /, **arguments: Argument) -> Message:
    """Message with the arguments that the text of this key asks for."""
    return Message(key, MappingProxyType(arguments))


def group_reasons(reasons: Iterable[Message]) -> tuple[Message, ...]:
    """One reason of each kind, with its count: the most frequent first.

    Parameters
    ----------
    reasons : iterable of Message
        Of a kind are those that differ in numbers and names alone; the first in the
        order of their texts stands for all.

    Returns
    -------
    tuple of Message
        ``12 times: no steady state was found ...``; one that stands alone as it is.
    """
    kinds: dict[_Kind, list[Message]] = {}
    for reason in sorted(reasons, key=lambda reason: (str(reason), repr(reason))):
        kinds.setdefault(_find_kind(reason), []).append(reason)
    grouped = sorted(kinds.values(), key=lambda alike: -len(alike))
    return tuple(
        say("text.times", count=len(alike), reason=alike[0])
        if len(alike) > 1
        else alike[0]
        for alike in grouped
    )


_Kind = tuple[Any, ...]


def _find_kind(message: Message) -> _Kind:
    """Keys of a message and of those in its gaps; of a plain text, the text."""
    if message.key == "text.as_given":
        return (message.arguments["text"],)
    arguments = [message.arguments[name] for name in sorted(message.arguments)]
    parts = [x if isinstance(x, tuple) else (x,) for x in arguments]
    inner = (x for part in parts for x in part if isinstance(x, Message))
    return (message.key, *map(_find_kind, inner))


def restore(plain: Mapping[str, Any]) -> Message:
    """Message from its plain values.

    Raises
    ------
    KeyError, TypeError, AttributeError
        If they are none.
    """
    arguments = plain["arguments"].items()
    return say(str(plain["key"]), **{name: _read(value) for name, value in arguments})


def _read(value: Any) -> Argument:
    if isinstance(value, Mapping):
        return restore(value)
    if isinstance(value, list):
        return tuple(_read(part) for part in value)  # type: ignore[misc]
    return value  # type: ignore[no-any-return]


def _restore(key: str, arguments: dict[str, Argument]) -> Message:
    return say(key, **arguments)


class _HasText:
    """A message with a text of this key whose gaps its arguments fill."""

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> CoreSchema:
        """Schema that pydantic asks for: read a message as usual, then render it."""
        from pydantic_core.core_schema import no_info_after_validator_function

        return no_info_after_validator_function(_require_text, handler(source))


def _require_text(message: Message) -> Message:
    from netdesign.words.catalogue import render

    try:
        render(message, "en")
    except (LookupError, ValueError, RecursionError) as error:
        key = f"{message.key!r:.60}"
        raise ValueError(f"{key} is no text with these arguments: {error}") from None
    return message


Text = Annotated[Message, _HasText()]  # in no language yet; never one without a text
