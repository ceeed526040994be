"""Images as arrays: every encoding, with padding and in both byte orders."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from aioros1.contrib.numpy import array_to_image, image_to_array
from aioros1.msg.sensor_msgs import CompressedImage, Image
from aioros1.msg.std_msgs import Header

NAMED = {
    **{f"{order}{bits}": (f"u{bits // 8}", len(order))
       for order in ("rgb", "bgr", "rgba", "bgra") for bits in (8, 16)},
    **{f"mono{bits}": (f"u{bits // 8}", 1) for bits in (8, 16)},
    **{f"bayer_{order}{bits}": (f"u{bits // 8}", 1)
       for order in ("rggb", "bggr", "gbrg", "grbg") for bits in (8, 16)},
    "yuv422": ("u1", 2), "yuv422_yuy2": ("u1", 2),
}  # fmt: skip
PREFIXES = {"8U": "u1", "8S": "i1", "16U": "u2", "16S": "i2", "32S": "i4", "32F": "f4", "64F": "f8"}
GENERIC = {
    **{f"{prefix}C{count}": (kind, count)
       for prefix, kind in PREFIXES.items() for count in (1, 2, 3, 4, 5, 17)},
    **{f"{prefix}C": (kind, 1) for prefix, kind in PREFIXES.items()},
}  # fmt: skip
ENCODINGS = {**NAMED, **GENERIC}

encodings = st.sampled_from(sorted(ENCODINGS))
sizes = st.integers(0, 5)


def pixels_of(encoding, height, width, seed=1):
    kind, channels = ENCODINGS[encoding]
    shape = (height, width) if channels == 1 else (height, width, channels)
    count = int(np.prod(shape)) * np.dtype(kind).itemsize
    octets = np.random.default_rng(seed).integers(0, 256, count, np.uint8)
    pixels = octets.view(kind).reshape(shape)
    return np.nan_to_num(pixels) if pixels.dtype.kind == "f" else pixels


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_every_encoding_survives(encoding):
    pixels = pixels_of(encoding, 3, 4)
    image = array_to_image(pixels, encoding, header=Header(frame_id="camera"))
    assert (image.height, image.width, image.encoding) == (3, 4, encoding)
    assert image.step * 3 == len(image.data) == pixels.nbytes
    assert image.header.frame_id == "camera"
    received = Image.from_bytes(image.to_bytes())
    array = image_to_array(received)
    assert array.dtype == pixels.dtype
    assert array.dtype.isnative
    np.testing.assert_array_equal(array, pixels)


@given(encodings, sizes, sizes, st.integers(0, 9), st.booleans(), st.integers(0, 2**32))
def test_rows_with_padding_in_both_byte_orders(encoding, height, width, padding, big, seed):
    pixels = pixels_of(encoding, height, width, seed)
    swapped = pixels.astype(pixels.dtype.newbyteorder(">" if big else "<"))
    rows = (
        swapped.reshape(height, -1).view(np.uint8) if pixels.size else np.empty((height, 0), "u1")
    )
    padded = np.pad(rows, ((0, 0), (0, padding)), constant_values=255)
    image = Image(
        height=height,
        width=width,
        encoding=encoding,
        is_bigendian=big,
        step=padded.shape[1],
        data=padded.tobytes(),
    )
    array = image_to_array(image)
    assert array.dtype == pixels.dtype
    np.testing.assert_array_equal(array, pixels)
    # The padding of the last row may be missing.
    image.data = image.data[: len(image.data) - padding] if height else b""
    np.testing.assert_array_equal(image_to_array(image), pixels)


@pytest.mark.parametrize(("encoding", "rows"), [("nv21", 6), ("nv24", 12)])
def test_colours_behind_the_image(encoding, rows):
    pixels = np.arange(rows * 6, dtype=np.uint8).reshape(rows, 6)
    image = array_to_image(pixels, encoding)
    assert (image.height, image.width, image.step) == (4, 6, 6)
    np.testing.assert_array_equal(image_to_array(image), pixels)
    with pytest.raises(ValueError, match=r"expected uint8 of shape \(height \* 3/"):
        array_to_image(pixels[:5].astype("u2"), encoding)


def test_padding_between_rows_and_colours():
    pixels = np.arange(6 * 8, dtype=np.uint8).reshape(6, 8)
    image = Image(height=4, width=6, encoding="nv21", step=8, data=pixels.tobytes())
    np.testing.assert_array_equal(image_to_array(image), pixels[:, :6])
    image.encoding, image.data = "nv24", bytes(8 * 12)
    with pytest.raises(ValueError, match="step: expected 6 bytes for 6 pixels of nv24, got 8"):
        image_to_array(image)


def test_an_odd_number_of_rows_has_no_half_of_them():
    with pytest.raises(ValueError, match="expected even numbers for nv21, got 3, 4"):
        image_to_array(Image(height=3, width=4, encoding="nv21", step=4, data=bytes(24)))
    for shape in ((4, 4), (5, 4), (6, 3)):
        with pytest.raises(ValueError, match="nv21, got uint8"):
            array_to_image(np.zeros(shape, np.uint8), "nv21")


def test_without_an_encoding():
    for encoding in GENERIC:
        if not encoding.endswith("C"):
            assert array_to_image(pixels_of(encoding, 2, 3)).encoding == encoding
    assert array_to_image([[[1.5]]]).encoding == "64FC1"


class TestMemory:
    def test_what_was_received_is_a_view_that_cannot_be_written(self):
        image = Image.from_bytes(array_to_image(np.zeros((4, 5, 3), "u1"), "rgb8").to_bytes())
        array = image_to_array(image)
        assert np.shares_memory(array, np.frombuffer(image.data, np.uint8))
        with pytest.raises(ValueError, match="read-only"):
            array[0, 0] = 1
        array.copy()[0, 0] = 1

    def test_views_are_views(self):
        octets = array_to_image(np.zeros((4, 5), "f4"), "32FC1").to_bytes()
        image = Image.from_bytes(octets, views=True)
        assert np.shares_memory(image_to_array(image), np.frombuffer(octets, np.uint8))

    @pytest.mark.parametrize(
        "data",
        [
            bytes(6),
            bytearray(6),
            [0] * 6,
            (0,) * 6,
            np.zeros(6, "u1"),
            np.zeros(12, "u1")[::2],
            np.zeros((2, 3), "i1"),
            memoryview(bytes(12))[::2],
        ],
    )
    def test_any_bytes(self, data):
        image = Image(height=2, width=3, encoding="mono8", step=3, data=data)
        np.testing.assert_array_equal(image_to_array(image), np.zeros((2, 3), "u1"))

    def test_a_bytearray_can_be_written(self):
        image = Image(height=2, width=3, encoding="mono8", step=3, data=bytearray(6))
        image_to_array(image)[1, 2] = 7
        assert image.data[5] == 7

    def test_a_contiguous_array_is_shared(self):
        pixels = np.zeros((2, 3), "<u2")
        image = array_to_image(pixels, "mono16")
        pixels[0, 0] = 0x0102
        assert bytes(image.data[:2]) == b"\2\1"
        apart = array_to_image(pixels, "mono16", copy=True)
        pixels[0, 0] = 0
        assert bytes(apart.data[:2]) == b"\2\1"

    @pytest.mark.parametrize(
        "change", [lambda p: p[::-1], lambda p: p[:, ::2], lambda p: np.asfortranarray(p),
                   lambda p: p.astype(">u2")]
    )  # fmt: skip
    def test_any_other_is_copied(self, change):
        pixels = change(np.arange(24, dtype="<u2").reshape(4, 6))
        image = array_to_image(pixels, "mono16")
        assert not image.is_bigendian
        np.testing.assert_array_equal(image_to_array(image), pixels)


class TestMistakes:
    @pytest.mark.parametrize("encoding", ["", "rgb", "RGB8", "8UC0", "16FC1", "8UC-1", "8UC1 ",
                                          "jpeg", "8UC99999999999", "32UC1", "８UC1"])  # fmt: skip
    def test_unknown_encodings(self, encoding):
        image = Image(height=1, width=1, step=1, encoding=encoding, data=b"x")
        for convert in (lambda: image_to_array(image), lambda: array_to_image([[1]], encoding)):
            with pytest.raises(ValueError, match=r"encoding: expected one of .*, got '"):
                convert()

    @pytest.mark.parametrize(
        ("field", "value", "text"),
        [
            ("step", 11, "step: expected at least 12 bytes for 4 pixels of rgb8, got 11"),
            ("step", 0, "step: expected at least 12 bytes"),
            ("data", bytes(35), "data: expected at least 36 bytes for 3 rows of 12, got 35"),
            ("data", b"", "got 0"),
            ("data", "x" * 36, "data: expected bytes, got 'x"),
            ("data", [256] * 36, "data: expected bytes, got "),
            ("height", 4, "data: expected at least 48 bytes"),
            ("width", 4_000_000_000, "step: expected at least 12000000000 bytes"),
            ("height", 4_000_000_000, "data: expected at least 48000000000 bytes"),
        ],
    )
    def test_what_does_not_fit_together(self, field, value, text):
        image = array_to_image(np.zeros((3, 4, 3), np.uint8), "rgb8")
        setattr(image, field, value)
        with pytest.raises(ValueError, match=text):
            image_to_array(image)

    @pytest.mark.parametrize(
        ("array", "encoding", "text"),
        [
            (np.zeros((3, 4)), "mono8",
             r"uint8 of shape \(height, width\) for mono8, got float64 of shape \(3, 4\)"),
            (np.zeros((3, 4), "u1"), "bgr8", r"uint8 of shape \(height, width, 3\) for bgr8"),
            (np.zeros((3, 4, 4), "u1"), "bgr8", r"for bgr8, got uint8 of shape \(3, 4, 4\)"),
            (np.zeros((3, 4, 2), "u1"), "mono8", "for mono8, got uint8"),
            (np.zeros((3, 4), "i8"), None, r"array: expected numbers .* got int64"),
            (np.zeros((3, 4), "O"), None, "array: expected numbers .* got object"),
            (np.zeros((3, 4), bool), "mono8", "got bool"),
            (np.zeros(4, "u1"), "mono8", r"array: expected rows of pixels.* got uint8 .*\(4,\)"),
            (np.zeros((3, 4, 0), "u1"), None, "array: expected rows of pixels"),
            (5, None, "array: expected rows of pixels"),
        ],
    )  # fmt: skip
    def test_arrays_that_are_no_image(self, array, encoding, text):
        with pytest.raises(ValueError, match=text):
            array_to_image(array, encoding)

    @pytest.mark.parametrize(
        ("value", "text"),
        [
            (CompressedImage(), "expected a sensor_msgs/Image, got a sensor_msgs/CompressedImage"),
            (Image, "got the class Image"),
            (np.zeros((3, 4)), "expected a sensor_msgs/Image, got array"),
            (None, "got None"),
        ],
    )
    def test_what_is_no_image(self, value, text):
        with pytest.raises(TypeError, match=text):
            image_to_array(value)


async def test_from_one_node_to_another(make_node):
    node = await make_node()
    pixels = pixels_of("bgr8", 480, 640)
    async with (
        node.advertise("image", Image) as pub,
        node.subscribe("image", Image) as sub,
        node.subscribe("image") as other,
    ):
        await pub.wait_for_subscribers()
        pub.publish(array_to_image(pixels, "bgr8"))
        np.testing.assert_array_equal(image_to_array(await sub.get(timeout=20)), pixels)
        np.testing.assert_array_equal(image_to_array(await other.get(timeout=20)), pixels)


def test_numpy_is_imported_here_only():
    """All else that needs it is told by the module of an array."""
    package = Path(sys.modules["aioros1"].__file__).parent
    importing = {
        path.relative_to(package).as_posix()
        for path in package.rglob("*.py")
        if any(
            line.strip().startswith(("import numpy", "from numpy"))
            for line in path.read_text().splitlines()
        )
    }
    assert importing <= {
        f"contrib/_{name}.py" for name in ("buffers", "images", "point_clouds", "transforms")
    }
