"""Point clouds and laser scans as NumPy arrays."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aioros1 import AnyMessage, GenpyMessage
from aioros1._public import public
from aioros1.contrib._buffers import as_uint8, bytes_of, check_message, describe_array
from aioros1.msg.sensor_msgs import LaserScan, PointCloud2, PointField
from aioros1.msg.std_msgs import Header

__all__ = ["array_to_pointcloud2", "laserscan_to_points", "pointcloud2_to_array"]

_KINDS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
_DATATYPES = {kind: datatype for datatype, kind in _KINDS.items()}


@public("aioros1.contrib.numpy")
def pointcloud2_to_array(
    cloud: PointCloud2 | AnyMessage | GenpyMessage, fields: Sequence[str] | None = None
) -> NDArray[Any]:
    """Make a structured array of the points of a ``sensor_msgs/PointCloud2``.

    ``points["x"]`` is the field ``x`` of all points; ``fields`` selects some by name, in the
    order of the cloud. A field with a count above one is a sub-array. The shape is
    ``(width,)`` if the height is one, and ``(height, width)`` for an organised cloud. Fields
    without a name and those named ``_``, by which PCL marks padding, are left out. A count of
    zero, which old versions of PCL write, means one.

    The array shares the memory of ``cloud.data``, padding included, and is read-only if that
    is ``bytes``, as in a message you received. A big-endian cloud is copied on other machines.
    For an array of your own, call ``copy()``.

    Raises :class:`TypeError` for anything but a point cloud, and :class:`ValueError` for
    fields that cannot be, names that are not there, and too few bytes.
    """
    message: Any = check_message(cloud, "sensor_msgs/PointCloud2")
    height, width = int(message.height), int(message.width)
    point_step, row_step = int(message.point_step), int(message.row_step)
    dtype = _point_dtype(message, fields, point_step)
    shape = (width,) if height == 1 else (height, width)
    if not height or not width:
        return np.empty(shape, dtype)
    if height > 1 and row_step < width * point_step:
        raise ValueError(
            f"row_step: expected at least {width * point_step} bytes for {width} points of "
            f"{point_step}, got {row_step}"
        )
    data = as_uint8(message.data, "data")
    needed = (row_step * (height - 1) if height > 1 else 0) + width * point_step
    if data.size < needed:
        raise ValueError(
            f"data: expected at least {needed} bytes for {height} rows of {width} points of "
            f"{point_step} bytes, got {data.size}"
        )
    strides = (point_step,) if height == 1 else (row_step, point_step)
    stored = dtype.newbyteorder(">" if message.is_bigendian else "<")
    points: NDArray[Any] = np.ndarray(shape, stored, data.data, strides=strides)
    return points.astype(dtype, copy=False)


def _point_dtype(cloud: Any, wanted: Sequence[str] | None, point_step: int) -> np.dtype[Any]:
    """The dtype of one point, in the byte order of this machine."""
    if isinstance(wanted, str):
        wanted = (wanted,)
    if point_step >= 1 << 31:  # which NumPy has no dtype for
        raise ValueError(f"point_step: expected less than 2 GiB for a point, got {point_step}")
    names, formats, offsets = [], [], []
    for number, field in enumerate(cloud.fields):
        name = str(field.name)
        place = f"fields[{number}] ({name})"
        if name in ("", "_") or (wanted is not None and name not in wanted):
            continue
        if name in names:
            raise ValueError(f"{place}: there is another field of that name")
        kind = _KINDS.get(int(field.datatype))
        if kind is None:
            raise ValueError(f"{place}: expected a datatype from 1 to 8, got {field.datatype}")
        count, offset = int(field.count) or 1, int(field.offset)
        end = offset + count * np.dtype(kind).itemsize
        if end > point_step:
            raise ValueError(
                f"{place}: expected to end within the {point_step} bytes of a point, "
                f"got an end at {end}"
            )
        names.append(name)
        formats.append(np.dtype((kind, (count,))) if count > 1 else np.dtype(kind))
        offsets.append(offset)
    missing = [name for name in wanted or () if name not in names]
    if missing:
        known = ", ".join(str(field.name) for field in cloud.fields)
        raise ValueError(f"fields: expected some of {known}, got {', '.join(map(repr, missing))}")
    return np.dtype(
        {"names": names, "formats": formats, "offsets": offsets, "itemsize": point_step}
    )


@public("aioros1.contrib.numpy")
def array_to_pointcloud2(
    array: ArrayLike,
    names: Sequence[str] = ("x", "y", "z"),
    *,
    header: Header | GenpyMessage | None = None,
    is_dense: bool = False,
    copy: bool = False,
) -> PointCloud2:
    """Make a ``sensor_msgs/PointCloud2`` of an array of points.

    A structured array, as :func:`pointcloud2_to_array` gives it, has one or two dimensions; its
    fields keep their names, offsets and padding. In a plain array the last dimension holds the
    values of each point, which ``names`` names. Set ``is_dense`` if no point has a NaN or an
    infinity; nothing checks it.

    An array that is contiguous and in little-endian byte order is not copied: the cloud shares
    its memory, so change it only after you have published the cloud, or set ``copy``. Any other
    array is copied.

    Raises :class:`ValueError` for an array of another shape, and for numbers that no field can
    have, such as ``int64``.
    """
    points: NDArray[Any] = np.asarray(array)
    if points.dtype.names is None:
        points = _with_names(points, names)
    if points.ndim not in (1, 2):
        raise ValueError(
            f"array: expected points in one dimension, or in two if they are organised, "
            f"got shape {points.shape}"
        )
    fields = _point_fields(points.dtype)
    stored = np.ascontiguousarray(points, points.dtype.newbyteorder("<"))
    height, width = (1, *points.shape)[-2:]
    step = stored.dtype.itemsize
    header_: Any = Header() if header is None else header  # genpy's too
    return PointCloud2(
        header=header_,
        height=height,
        width=width,
        fields=fields,
        is_bigendian=False,
        point_step=step,
        row_step=step * width,
        data=bytes_of(stored, copy=copy),
        is_dense=is_dense,
    )


def _with_names(points: NDArray[Any], names: Sequence[str]) -> NDArray[Any]:
    """A plain array as one of points with fields."""
    if points.ndim < 2 or points.shape[-1] != len(names):
        raise ValueError(
            f"array: expected a structured array, or one whose last dimension is "
            f"{len(names)} for {', '.join(names)}, got {describe_array(points)}"
        )
    if f"{points.dtype.kind}{points.dtype.itemsize}" not in _DATATYPES:
        raise ValueError(
            f"array: expected numbers that a point can have ({', '.join(_DATATYPES)}), "
            f"got {describe_array(points)}"
        )
    dtype = np.dtype([(name, points.dtype) for name in names])
    named: NDArray[Any] = np.ascontiguousarray(points).view(dtype)[..., 0]
    return named


def _point_fields(dtype: np.dtype[Any]) -> list[PointField]:
    if not dtype.names:
        raise ValueError("array: expected at least one field, got none")
    fields = []
    described: Any = dtype.fields
    for name in dtype.names:
        inner, offset = described[name][:2]
        base, shape = inner.subdtype or (inner, ())
        kind = f"{base.kind}{base.itemsize}"
        if kind not in _DATATYPES:
            raise ValueError(
                f"array[{name!r}]: expected numbers that a point can have "
                f"({', '.join(_DATATYPES)}), got {inner}"
            )
        count = math.prod(shape)
        fields.append(PointField(name=name, offset=offset, datatype=_DATATYPES[kind], count=count))
    return fields


@public("aioros1.contrib.numpy")
def laserscan_to_points(
    scan: LaserScan | AnyMessage | GenpyMessage,
    *,
    intensities: bool = False,
    keep_invalid: bool = False,
) -> NDArray[np.float64]:
    """Make an array of the points of a ``sensor_msgs/LaserScan``, in the frame of the scanner.

    The shape is ``(n, 3)``: x, y, and z, which is zero. With ``intensities`` a fourth column has
    the intensity of each. A range counts if it is a number from ``range_min`` to ``range_max``;
    NaNs, infinities and all others are left out. With ``keep_invalid`` there is a row for each
    range, with NaN as x, y and z of the invalid ones. A ``range_max`` of zero was not filled in,
    and is no bound.

    Raises :class:`TypeError` for anything but a laser scan, and :class:`ValueError` if there is
    not one intensity for each range.
    """
    message: Any = check_message(scan, "sensor_msgs/LaserScan")
    ranges = np.array(message.ranges, np.float64)
    angles = message.angle_min + np.arange(ranges.size) * float(message.angle_increment)
    limit = message.range_max if message.range_max != 0 else math.inf
    # A comparison with NaN is false.
    valid = np.isfinite(ranges) & (ranges >= message.range_min) & (ranges <= limit)
    points = np.zeros((ranges.size, 4 if intensities else 3))
    distances = np.where(valid, ranges, np.nan)
    points[:, 0] = distances * np.cos(angles)
    points[:, 1] = distances * np.sin(angles)
    points[~valid, 2] = np.nan
    if intensities:
        strengths = np.array(message.intensities, np.float64)
        if strengths.size != ranges.size:
            raise ValueError(
                f"intensities: expected {ranges.size}, one for each range, got {strengths.size}"
            )
        points[:, 3] = strengths
    return points if keep_invalid else points[valid]
