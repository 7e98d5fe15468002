"""A message as a field of a stored record: read back only if a text has its key."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from netdesign.words.catalogue import render
from netdesign.words.message import Message

if TYPE_CHECKING:
    from pydantic_core import CoreSchema


class _HasText:
    """A message with a text of this key whose gaps its arguments fill."""

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> CoreSchema:
        """Schema that pydantic asks for: read a message as usual, then render it."""
        from pydantic_core.core_schema import no_info_after_validator_function

        return no_info_after_validator_function(_require_text, handler(source))


def _require_text(message: Message) -> Message:
    try:
        render(message, "en")
    except (LookupError, ValueError, RecursionError) as error:
        key = f"{message.key!r:.60}"
        raise ValueError(f"{key} is no text with these arguments: {error}") from None
    return message


Text = Annotated[Message, _HasText()]  # in no language yet; never one without a text
