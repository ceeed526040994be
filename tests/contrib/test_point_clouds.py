"""Point clouds and laser scans as arrays."""

from __future__ import annotations

import math
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from aioros1.contrib.numpy import (
    array_to_pointcloud2,
    laserscan_to_points,
    pointcloud2_to_array,
)
from aioros1.msg.sensor_msgs import LaserScan, PointCloud, PointCloud2, PointField
from aioros1.msg.std_msgs import Header

KINDS = {1: "b", 2: "B", 3: "h", 4: "H", 5: "i", 6: "I", 7: "f", 8: "d"}

fields = st.lists(st.tuples(st.sampled_from(list(KINDS)), st.integers(0, 3), st.integers(0, 5)),
                  min_size=1, max_size=6)  # fmt: skip


@given(fields, st.integers(0, 3), st.integers(0, 4), st.integers(0, 9), st.booleans(), st.data())
def test_what_struct_reads(layout, height, width, padding, big, data):
    """Any fields, in any order in the message, with holes, padding and both byte orders."""
    order = ">" if big else "<"
    offset, listed, formats = 0, [], []
    for number, (datatype, count, hole) in enumerate(layout):
        offset += hole
        text = f"{order}{count or 1}{KINDS[datatype]}"
        listed.append(PointField(name=f"f{number}", offset=offset, datatype=datatype, count=count))
        formats.append((offset, text))
        offset += struct.calcsize(text)
    point_step = offset + padding
    row_step = width * point_step + (padding if height > 1 else 0)
    octets = data.draw(st.binary(min_size=height * row_step, max_size=height * row_step))
    cloud = PointCloud2(
        height=height,
        width=width,
        fields=data.draw(st.permutations(listed)),
        is_bigendian=big,
        point_step=point_step,
        row_step=row_step,
        data=octets,
    )
    points = pointcloud2_to_array(PointCloud2.from_bytes(cloud.to_bytes()))
    assert points.shape == ((width,) if height == 1 else (height, width))
    assert points.dtype.itemsize == point_step
    for index in np.ndindex(height, width):
        start = index[0] * row_step + index[1] * point_step
        point = points[index[-points.ndim :]]
        for number, (place, text) in enumerate(formats):
            expected = struct.unpack_from(text, octets, start + place)
            found = np.atleast_1d(point[f"f{number}"])
            np.testing.assert_array_equal(found, np.array(expected, found.dtype))


@given(fields, st.sampled_from([(0,), (1,), (4,), (0, 3), (2, 3), (1, 5)]), st.booleans())
def test_an_array_survives(layout, shape, big):
    dtype = np.dtype({
        "names": [f"f{number}" for number in range(len(layout))],
        "formats": [
            np.dtype((f"{'>' if big else '<'}{KINDS[kind]}", (count,))) if count > 1
            else np.dtype(f"{'>' if big else '<'}{KINDS[kind]}")
            for kind, count, _ in layout
        ],
    })  # fmt: skip
    points = np.zeros(shape, dtype)
    for number, name in enumerate(points.dtype.names):
        column = points[name]
        column[...] = np.arange(column.size).reshape(column.shape) % 100 + number
    cloud = array_to_pointcloud2(points, header=Header(frame_id="map"))
    assert (cloud.header.frame_id, cloud.is_bigendian, cloud.is_dense) == ("map", False, False)
    found = pointcloud2_to_array(PointCloud2.from_bytes(cloud.to_bytes()))
    expected_shape = shape[1:] if len(shape) == 2 and shape[0] == 1 else shape
    assert found.shape == expected_shape
    for name in points.dtype.names:
        column = points[name].reshape(found[name].shape)
        np.testing.assert_array_equal(found[name], column)


def xyz(count=4, **changes):
    cloud = array_to_pointcloud2(np.arange(count * 3, dtype="f4").reshape(count, 3))
    for name, value in changes.items():
        setattr(cloud, name, value)
    return cloud


class TestClouds:
    def test_a_plain_array_has_the_fields_x_y_and_z(self):
        cloud = xyz()
        assert [(f.name, f.offset, f.datatype, f.count) for f in cloud.fields] == [
            ("x", 0, 7, 1), ("y", 4, 7, 1), ("z", 8, 7, 1),
        ]  # fmt: skip
        assert (cloud.height, cloud.width, cloud.point_step, cloud.row_step) == (1, 4, 12, 48)
        np.testing.assert_array_equal(pointcloud2_to_array(cloud)["y"], [1, 4, 7, 10])

    def test_an_organised_plain_array_with_other_names(self):
        array = np.arange(24, dtype="f8").reshape(2, 3, 4)
        cloud = array_to_pointcloud2(array, ["x", "y", "z", "intensity"], is_dense=True)
        assert (cloud.height, cloud.width, cloud.row_step, cloud.is_dense) == (2, 3, 96, True)
        np.testing.assert_array_equal(pointcloud2_to_array(cloud)["intensity"], array[:, :, 3])

    def test_some_fields(self):
        points = pointcloud2_to_array(xyz(), ["z", "x"])
        assert points.dtype.names == ("x", "z")
        np.testing.assert_array_equal(points["z"], [2, 5, 8, 11])
        assert pointcloud2_to_array(xyz(), "y").dtype.names == ("y",)

    def test_fields_in_one_place(self):
        """PCL has the colour as a float, and others the same bytes as a number."""
        cloud = xyz()
        cloud.fields.append(PointField(name="rgb", offset=8, datatype=6, count=1))
        points = pointcloud2_to_array(cloud)
        np.testing.assert_array_equal(points["rgb"].view("f4"), points["z"])

    def test_padding_of_pcl_is_left_out(self):
        cloud = xyz()
        for field in cloud.fields[1:]:
            field.name = "_"
        assert pointcloud2_to_array(cloud).dtype.names == ("x",)

    def test_what_was_received_is_a_view_that_cannot_be_written(self):
        cloud = PointCloud2.from_bytes(xyz().to_bytes())
        points = pointcloud2_to_array(cloud)
        assert np.shares_memory(points, np.frombuffer(cloud.data, np.uint8))
        with pytest.raises(ValueError, match="read-only"):
            points["x"][0] = 1

    def test_a_contiguous_array_is_shared(self):
        array = np.zeros((2, 3), "<f4")
        cloud = array_to_pointcloud2(array)
        apart = array_to_pointcloud2(array, copy=True)
        array[1, 2] = 5
        assert pointcloud2_to_array(cloud)["z"][1] == 5
        assert pointcloud2_to_array(apart)["z"][1] == 0

    @pytest.mark.parametrize(
        "change", [lambda a: a[::-1], lambda a: a[:, ::-1], np.asfortranarray,
                   lambda a: a.astype(">f4")]
    )  # fmt: skip
    def test_any_other_is_copied(self, change):
        array = change(np.arange(12, dtype="<f4").reshape(4, 3))
        points = pointcloud2_to_array(array_to_pointcloud2(array))
        np.testing.assert_array_equal(points["z"], array[:, 2])

    def test_a_selection_of_fields_keeps_its_places(self):
        points = pointcloud2_to_array(xyz())[["x", "z"]]
        cloud = array_to_pointcloud2(points)
        assert [(field.name, field.offset) for field in cloud.fields] == [("x", 0), ("z", 8)]
        np.testing.assert_array_equal(pointcloud2_to_array(cloud)["z"], points["z"])

    def test_a_row_step_that_nobody_needs_may_be_missing(self):
        assert pointcloud2_to_array(xyz(row_step=0)).shape == (4,)

    @pytest.mark.parametrize(
        ("changes", "text"),
        [
            ({"data": bytes(47)}, "data: expected at least 48 bytes for 1 rows of 4 points of 12"),
            ({"width": 5}, "data: expected at least 60 bytes"),
            ({"height": 2}, "data: expected at least 96 bytes"),
            ({"height": 2, "row_step": 47}, "row_step: expected at least 48 bytes"),
            ({"height": 4_000_000_000, "row_step": 48}, "data: expected at least 192000000000"),
            ({"width": 4_000_000_000}, "data: expected at least 48000000000 bytes"),
            ({"point_step": 11}, r"fields\[2\] \(z\): expected to end within the 11 bytes"),
            ({"point_step": 4_000_000_000}, "point_step: expected less than 2 GiB"),
            ({"fields": [PointField(name="x", datatype=9, count=1)]},
             r"fields\[0\] \(x\): expected a datatype from 1 to 8, got 9"),
            ({"fields": [PointField(name="x", datatype=7, count=1)] * 2},
             r"fields\[1\] \(x\): there is another field of that name"),
            ({"fields": [PointField(name="x", datatype=8, count=4_000_000_000)]},
             "expected to end within the 12 bytes of a point, got an end at 32000000000"),
            ({"data": "x" * 48}, "data: expected bytes"),
        ],
    )  # fmt: skip
    def test_what_does_not_fit_together(self, changes, text):
        with pytest.raises(ValueError, match=text):
            pointcloud2_to_array(xyz(**changes))

    def test_what_is_no_cloud(self):
        with pytest.raises(TypeError, match="expected a sensor_msgs/PointCloud2, got a sensor_msg"):
            pointcloud2_to_array(PointCloud())
        with pytest.raises(ValueError, match="fields: expected some of x, y, z, got 'rgb'"):
            pointcloud2_to_array(xyz(), ["x", "rgb"])

    @pytest.mark.parametrize(
        ("array", "text"),
        [
            (np.zeros((4, 2), "f4"), r"last dimension is 3 for x, y, z, got float32 .*\(4, 2\)"),
            (np.zeros(3, "f4"), "array: expected a structured array"),
            (5, "array: expected a structured array"),
            (np.zeros((2, 2, 2, 3), "f4"), "points in one dimension, or in two"),
            (np.zeros((4, 3), "i8"), r"numbers that a point can have .* got int64"),
            (np.zeros(4, [("x", "f4"), ("t", "i8")]), r"array\['t'\]: expected numbers .* int64"),
            (np.zeros(4, [("x", "f4"), ("s", "S4")]), r"array\['s'\]: expected numbers"),
            (np.zeros(4, [("a", [("x", "f4")])]), r"array\['a'\]: expected numbers"),
            (np.zeros(4, []), "array: expected at least one field, got none"),
        ],
    )
    def test_arrays_that_are_no_cloud(self, array, text):
        with pytest.raises(ValueError, match=text):
            array_to_pointcloud2(array)


class TestScans:
    def scan(self, ranges, **fields):
        fields = {"range_min": 0.5, "range_max": 10.0, "angle_increment": 0.1, **fields}
        return LaserScan(ranges=ranges, **fields)

    @given(st.lists(st.floats(0.5, 10, width=32)), st.floats(-7, 7, width=32),
           st.floats(-1, 1, width=32))  # fmt: skip
    def test_the_formula(self, ranges, angle_min, increment):
        scan = self.scan(ranges, angle_min=angle_min, angle_increment=increment)
        points = laserscan_to_points(LaserScan.from_bytes(scan.to_bytes()))
        assert points.shape == (len(ranges), 3)
        for number, (distance, point) in enumerate(zip(ranges, points, strict=True)):
            angle = angle_min + number * increment
            expected = distance * math.cos(angle), distance * math.sin(angle), 0
            np.testing.assert_allclose(point, expected, rtol=1e-9, atol=1e-9)

    def test_ranges_that_do_not_count(self):
        ranges = [math.nan, math.inf, -math.inf, 0, 0.49, 10.01, -1, 0.5, 10]
        scan = self.scan(ranges, angle_increment=0, intensities=list(range(9)))
        np.testing.assert_allclose(laserscan_to_points(scan), [[0.5, 0, 0], [10, 0, 0]])
        points = laserscan_to_points(scan, intensities=True)
        np.testing.assert_allclose(points[:, 3], [7, 8])
        points = laserscan_to_points(scan, intensities=True, keep_invalid=True)
        assert points.shape == (9, 4)
        assert np.isnan(points[:7, :3]).all()
        np.testing.assert_allclose(points[:, 3], range(9))
        np.testing.assert_allclose(points[7:, 0], [0.5, 10])

    def test_bounds_that_were_not_filled_in(self):
        points = laserscan_to_points(LaserScan(ranges=[1.0, 2.0, math.inf]))
        np.testing.assert_allclose(points, [[1, 0, 0], [2, 0, 0]])

    def test_no_ranges(self):
        assert laserscan_to_points(LaserScan()).shape == (0, 3)
        assert laserscan_to_points(LaserScan(), intensities=True).shape == (0, 4)

    def test_an_infinite_range_max(self):
        points = laserscan_to_points(self.scan([1, math.inf], range_max=math.inf))
        assert points.shape == (1, 3)

    def test_what_is_refused(self):
        with pytest.raises(ValueError, match="intensities: expected 2, one for each range, got 1"):
            laserscan_to_points(self.scan([1, 2], intensities=[1]), intensities=True)
        with pytest.raises(TypeError, match="expected a sensor_msgs/LaserScan, got a sensor_msgs/"):
            laserscan_to_points(PointCloud2())

    def test_as_a_cloud(self):
        scan = self.scan([1, 2], intensities=[5, 6])
        points = laserscan_to_points(scan, intensities=True)
        cloud = array_to_pointcloud2(
            points.astype("f4"), ("x", "y", "z", "intensity"), header=scan.header, is_dense=True
        )
        np.testing.assert_allclose(pointcloud2_to_array(cloud)["intensity"], [5, 6])
