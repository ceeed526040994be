"""Decoders: they turn received bytes into what a subscriber hands out."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NoReturn
from weakref import WeakKeyDictionary

from aioros1.errors import DeserializationError, InvalidNameError, MessageError
from aioros1.idl.codec import codec_of
from aioros1.net.topic_links import IncomingLink, Received

if TYPE_CHECKING:
    from aioros1.idl import Message, MessageStore
    from aioros1.wire.handshake import TopicOffer

__all__ = ["Decoder", "decoder_for"]

Decoder = Callable[[Received], Any]


def decoder_for(
    message_class: type[Message] | None, store: MessageStore, *, raw: bool, views: bool
) -> Decoder:
    """Return a decoder from frames to messages of ``message_class``, or to bytes if ``raw``.

    Without a class, each publisher's messages are decoded by that publisher's definition;
    ``store`` keeps the definitions. With ``views``, arrays of numbers are not copied. The
    decoder raises :class:`~aioros1.DeserializationError`.
    """
    if raw:
        return _raw
    if message_class is not None:
        return _decoder_of(message_class, views)
    return _AnyDecoder(store, views)


def _raw(item: Received) -> bytes:
    batch, start, stop = item
    return bytes(batch.data[start:stop])


def _decoder_of(cls: type[Message], views: bool) -> Decoder:
    """Return a decoder for frames of ``cls``: small ones are bytes, large ones a view."""
    codec = codec_of(cls)
    small, large, with_views = codec.decode, codec.decode_view, codec.decode_views

    def decode_views(item: Received) -> Any:
        batch, start, stop = item
        return with_views(memoryview(batch.data), start, stop)

    def decode(item: Received) -> Any:
        batch, start, stop = item
        data = batch.data
        if isinstance(data, bytes):
            return small(data, start, stop)
        return large(data, start, stop)

    return decode_views if views else decode


class _AnyDecoder:
    """Decodes every publisher's messages from that publisher's own definition."""

    def __init__(self, store: MessageStore, views: bool) -> None:
        self._store = store
        self._views = views
        # Weak, because publishers come and go and the subscriber stays.
        self._decoders: WeakKeyDictionary[IncomingLink, Decoder] = WeakKeyDictionary()

    def __call__(self, item: Received) -> Any:
        link = item[0].link
        decoder = self._decoders.get(link)
        if decoder is None:
            decoder = self._decoders[link] = self._decoder_for(link.offer)
        return decoder(item)

    def _decoder_for(self, offer: TopicOffer) -> Decoder:
        try:
            cls = self._store.add_definition(offer.type, offer.definition)
        except (MessageError, InvalidNameError) as error:
            return _undecodable(f"the publisher's definition of {offer.type}: {error}")
        if offer.md5sum not in ("*", cls._md5sum):
            return _undecodable(
                f"the publisher's definition of {offer.type} has md5sum {cls._md5sum}, "
                f"but it announced {offer.md5sum}"
            )
        return _decoder_of(cls, self._views)


def _undecodable(why: str) -> Decoder:
    def decode(item: Received) -> NoReturn:
        raise DeserializationError(why)

    return decode
