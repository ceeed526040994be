"""Images as NumPy arrays."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aioros1 import AnyMessage, GenpyMessage
from aioros1._public import public
from aioros1.contrib._buffers import as_uint8, bytes_of, check_message, describe_array
from aioros1.msg.sensor_msgs import Image
from aioros1.msg.std_msgs import Header

__all__ = ["array_to_image", "image_to_array"]


@dataclass(frozen=True, slots=True)
class _Layout:
    """How an encoding arranges the pixels of an image."""

    kind: str
    """The kind and size of a number, as in NumPy's ``"u2"``."""
    channels: int
    rows: tuple[int, int] = (1, 1)
    """Numerator and denominator of the rows of bytes for each row of pixels, for encodings
    that have their colours behind the image."""

    def shape(self, height: int, width: int) -> tuple[int, ...]:
        rows = height * self.rows[0] // self.rows[1]
        return (rows, width) if self.channels == 1 else (rows, width, self.channels)


_GENERIC = re.compile(r"(8U|8S|16U|16S|32S|32F|64F)C([0-9]{0,6})")
_KINDS = {"8U": "u1", "8S": "i1", "16U": "u2", "16S": "i2", "32S": "i4", "32F": "f4", "64F": "f8"}
_PREFIXES = {kind: prefix for prefix, kind in _KINDS.items()}

_NAMED = {
    **{f"{order}{bits}": _Layout(f"u{bits // 8}", len(order))
       for order in ("rgb", "bgr", "rgba", "bgra") for bits in (8, 16)},
    **{f"mono{bits}": _Layout(f"u{bits // 8}", 1) for bits in (8, 16)},
    **{f"bayer_{order}{bits}": _Layout(f"u{bits // 8}", 1)
       for order in ("rggb", "bggr", "gbrg", "grbg") for bits in (8, 16)},
    **{name: _Layout("u1", 2) for name in ("yuv422", "yuv422_yuy2", "uyvy", "yuyv")},
    "nv21": _Layout("u1", 1, (3, 2)),
    "nv24": _Layout("u1", 1, (3, 1)),
}  # fmt: skip


def _layout(encoding: str) -> _Layout:
    found = _NAMED.get(encoding)
    if found is not None:
        return found
    generic = _GENERIC.fullmatch(encoding) if isinstance(encoding, str) else None
    channels = int(generic[2] or 1) if generic is not None else 0
    if generic is None or not channels:
        raise ValueError(
            f"encoding: expected one of sensor_msgs/image_encodings.h, such as 'bgr8', 'mono16' "
            f"or '32FC1', got {encoding!r:.200}"
        )
    return _Layout(_KINDS[generic[1]], channels)


@public("aioros1.contrib.numpy")
def image_to_array(image: Image | AnyMessage | GenpyMessage) -> NDArray[Any]:
    """Make an array of the pixels of a ``sensor_msgs/Image``, as its encoding has them.

    The array has the shape ``(height, width)`` if a pixel is one number, as in ``mono8``,
    ``bayer_rggb16`` and ``32FC1``, and ``(height, width, channels)`` otherwise. No colours are
    converted: ``bgr8`` gives blue first. ``yuv422`` and ``yuv422_yuy2`` have two channels;
    ``nv21`` and ``nv24`` have the rows of the image, and below them those of the colours, as
    OpenCV expects them.

    The array shares the memory of ``image.data``, padding at the ends of rows included, and
    is read-only if that is ``bytes``, as in a message you received. Numbers of more than a byte
    in the other byte order are copied. For an array of your own, call ``copy()``.

    Raises :class:`TypeError` for anything but an image, and :class:`ValueError` for an unknown
    encoding and for too few bytes.
    """
    message: Any = check_message(image, "sensor_msgs/Image")
    layout = _layout(message.encoding)
    height, width, step = int(message.height), int(message.width), int(message.step)
    rows = height * layout.rows[0] // layout.rows[1]
    dtype = np.dtype(layout.kind)
    row_bytes = width * layout.channels * dtype.itemsize
    shape = layout.shape(height, width)
    if not rows or not width:
        return np.empty(shape, dtype)
    if layout.rows[1] > 1 and (height % 2 or width % 2):
        raise ValueError(
            f"height, width: expected even numbers for {message.encoding}, got {height}, {width}"
        )
    # The rows of colours of nv24 are twice as long as those of the image.
    if step < row_bytes or (message.encoding == "nv24" and step != row_bytes):
        raise ValueError(
            f"step: expected {'' if message.encoding == 'nv24' else 'at least '}"
            f"{row_bytes} bytes for {width} pixels of "
            f"{message.encoding}, got {step}"
        )
    data = as_uint8(message.data, "data")
    needed = step * (rows - 1) + row_bytes
    if data.size < needed:
        raise ValueError(
            f"data: expected at least {needed} bytes for {rows} rows of {step}, got {data.size}"
        )
    stored = dtype.newbyteorder(">" if message.is_bigendian else "<")
    strides = (step, layout.channels * dtype.itemsize, dtype.itemsize)[: len(shape)]
    # Checks the bounds again, and keeps the buffer alive.
    pixels: NDArray[Any] = np.ndarray(shape, stored, data.data, strides=strides)
    return pixels.astype(dtype, copy=False)


@public("aioros1.contrib.numpy")
def array_to_image(
    array: ArrayLike,
    encoding: str | None = None,
    *,
    header: Header | GenpyMessage | None = None,
    copy: bool = False,
) -> Image:
    """Make a ``sensor_msgs/Image`` of an array of pixels.

    The array has the shape and the dtype that :func:`image_to_array` gives for the
    ``encoding``. Without one, the image gets a generic encoding such as ``8UC3``, which says
    nothing about colours.

    An array that is contiguous and in little-endian byte order is not copied: the image shares
    its memory, so change it only after you have published the image, or set ``copy``. Any other
    array is copied.

    Raises :class:`ValueError` for an unknown encoding, and for an array that does not fit it.
    """
    pixels: NDArray[Any] = np.asarray(array)
    kind = f"{pixels.dtype.kind}{pixels.dtype.itemsize}"
    if pixels.ndim not in (2, 3) or 0 in pixels.shape[2:]:
        raise ValueError(
            f"array: expected rows of pixels, as in shape (480, 640) or (480, 640, 3), "
            f"got {describe_array(pixels)}"
        )
    if encoding is None:
        if kind not in _PREFIXES:
            raise ValueError(
                f"array: expected numbers that an image can have ({', '.join(_PREFIXES)}), "
                f"got {describe_array(pixels)}"
            )
        channels = pixels.shape[2] if pixels.ndim == 3 else 1
        encoding = f"{_PREFIXES[kind]}C{channels}"
    layout = _layout(encoding)
    if pixels.ndim == 3 and layout.channels == 1 and pixels.shape[2] == 1:
        pixels = pixels[:, :, 0]
    numerator, denominator = layout.rows
    rows, width = pixels.shape[:2]
    height = rows * denominator // numerator
    fits = layout.shape(height, width) == pixels.shape and kind == layout.kind
    if not fits or (denominator > 1 and (height % 2 or width % 2)):
        shape = {1: "(height, width)"}.get(layout.channels, f"(height, width, {layout.channels})")
        if layout.rows != (1, 1):
            shape = f"(height * {numerator}/{denominator}, width)"
        raise ValueError(
            f"array: expected {np.dtype(layout.kind)} of shape {shape} for {encoding}, "
            f"got {describe_array(pixels)}"
        )
    stored = np.ascontiguousarray(pixels, np.dtype(layout.kind).newbyteorder("<"))
    header_: Any = Header() if header is None else header  # genpy's too
    return Image(
        header=header_,
        height=height,
        width=width,
        encoding=encoding,
        is_bigendian=0,
        step=width * layout.channels * stored.dtype.itemsize,
        data=bytes_of(stored, copy=copy),
    )
