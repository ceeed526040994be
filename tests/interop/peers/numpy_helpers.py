"""``aioros1.contrib.numpy`` beside cv_bridge, sensor_msgs.point_cloud2, laser_geometry and tf.

In one process of Debian's Python: one check a run, by its name. The messages are genpy's.
"""

import math
import random
import sys

import geometry_msgs.msg
import numpy as np
import sensor_msgs.msg
import std_msgs.msg

from aioros1.contrib.numpy import (
    array_to_image,
    array_to_pointcloud2,
    image_to_array,
    laserscan_to_points,
    pointcloud2_to_array,
    transform_to_matrix,
)

HEADER = std_msgs.msg.Header(seq=1, frame_id="sensor")
NAMED = [
    "rgb8",
    "rgba8",
    "rgb16",
    "rgba16",
    "bgr8",
    "bgra8",
    "bgr16",
    "bgra16",
    "mono8",
    "mono16",
    "bayer_rggb8",
    "bayer_bggr8",
    "bayer_gbrg8",
    "bayer_grbg8",
    "bayer_rggb16",
    "bayer_bggr16",
    "bayer_gbrg16",
    "bayer_grbg16",
    "yuv422",
]
GENERIC = [
    f"{kind}C{count}"
    for kind in ["8U", "8S", "16U", "16S", "32S", "32F", "64F"]
    for count in range(1, 5)
]


def images():
    from cv_bridge import CvBridge

    bridge = CvBridge()
    numbers = np.random.default_rng(1)
    for encoding in NAMED + GENERIC:
        dtype, channels = bridge.encoding_to_dtype_with_channels(encoding)
        shape = (5, 7) if channels == 1 else (5, 7, channels)
        size = int(np.prod(shape)) * np.dtype(dtype).itemsize
        pixels = numbers.integers(0, 256, size, np.uint8).view(dtype).reshape(shape)
        if pixels.dtype.kind == "f":
            pixels = np.nan_to_num(pixels)
        for big in (False, True):
            message = sensor_msgs.msg.Image(
                header=HEADER,
                height=5,
                width=7,
                encoding=encoding,
                is_bigendian=big,
                step=size // 5,
                data=pixels.astype(pixels.dtype.newbyteorder(">" if big else "<")).tobytes(),
            )
            ours, theirs = image_to_array(message), bridge.imgmsg_to_cv2(message)
            assert ours.dtype == theirs.dtype, (encoding, ours.dtype, theirs.dtype)
            np.testing.assert_array_equal(ours, theirs, err_msg=encoding)
            np.testing.assert_array_equal(ours, pixels, err_msg=encoding)
        ours, theirs = array_to_image(pixels, encoding), bridge.cv2_to_imgmsg(pixels, encoding)
        for field in ("height", "width", "encoding", "is_bigendian", "step"):
            assert getattr(ours, field) == getattr(theirs, field), (encoding, field)
        assert bytes(ours.data) == theirs.data, encoding
        assert array_to_image(pixels).encoding == bridge.cv2_to_imgmsg(pixels).encoding


def clouds():
    from sensor_msgs.point_cloud2 import create_cloud, create_cloud_xyz32, read_points

    Field = sensor_msgs.msg.PointField  # noqa: N806
    chance = random.Random(1)
    for _ in range(200):
        fields, offset = [], 0
        for number in range(chance.randint(1, 6)):
            offset += chance.choice([0, 0, 1, 4])
            kind, count = chance.randint(1, 8), chance.choice([1, 1, 1, 3])
            fields.append(Field(f"f{number}", offset, kind, count))
            offset += count * [1, 1, 2, 2, 4, 4, 4, 8][kind - 1]
        height, width = chance.choice([(1, 5), (3, 4), (2, 1), (1, 0)])
        step, spare = offset + chance.choice([0, 3]), chance.choice([0, 5])
        row = width * step + spare
        cloud = sensor_msgs.msg.PointCloud2(
            header=HEADER,
            height=height,
            width=width,
            fields=fields,
            is_bigendian=chance.random() < 0.5,
            point_step=step,
            row_step=row,
            data=chance.randbytes(row * height),
        )
        ours = pointcloud2_to_array(cloud).reshape(-1)
        theirs = list(read_points(cloud))
        assert len(ours) == len(theirs)
        for found, expected in zip(ours, theirs, strict=True):
            flat = np.concatenate([np.ravel(found[field.name]).astype(float) for field in fields])
            np.testing.assert_array_equal(flat, np.array(expected, float))
    points = [(float(n), n / 3, -1.0) for n in range(10)]
    ours = array_to_pointcloud2(np.array(points, "f4"), header=HEADER)
    theirs = create_cloud_xyz32(HEADER, points)
    assert ours.to_bytes() == octets(theirs)
    dtype = [("a", "<u1"), ("b", "<f8"), ("c", "<i2", (2,))]
    rows = [(1, 2.5, (3, 4)), (255, -1.0, (5, -6))]
    listed = [Field("a", 0, 2, 1), Field("b", 1, 8, 1), Field("c", 9, 3, 2)]
    theirs = create_cloud(HEADER, listed, [(a, b, *c) for a, b, c in rows])
    assert array_to_pointcloud2(np.array(rows, dtype), header=HEADER).to_bytes() == octets(theirs)


def octets(message):
    import io

    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def scans():
    from laser_geometry import LaserProjection

    chance = random.Random(1)
    for _ in range(50):
        count = chance.randint(0, 40)
        odd = [math.nan, math.inf, -math.inf, 0.0, 30.5, 0.05]
        scan = sensor_msgs.msg.LaserScan(
            header=HEADER,
            angle_min=-2.0,
            angle_max=2.0 + _ / 100,  # theirs keeps the angles of the scan before
            angle_increment=chance.uniform(0.01, 0.1),
            range_min=0.1,
            range_max=30.0,
            ranges=[chance.choice([chance.uniform(0.1, 29), *odd]) for _ in range(count)],
            intensities=[chance.uniform(0, 255) for _ in range(count)],
        )
        ours = laserscan_to_points(scan, intensities=True)
        cloud = LaserProjection().projectLaser(scan)
        theirs = pointcloud2_to_array(cloud) if count else np.empty(0)
        assert len(ours) == cloud.width
        for column, name in enumerate(["x", "y", "z", "intensity"] if cloud.width else []):
            np.testing.assert_allclose(ours[:, column], theirs[name], rtol=1e-6, atol=1e-6)


def transforms():
    from tf.transformations import quaternion_matrix, random_quaternion, translation_matrix

    np.random.seed(1)
    for _ in range(200):
        quaternion, origin = random_quaternion() * np.random.uniform(0.1, 5), np.random.rand(3)
        expected = translation_matrix(origin) @ quaternion_matrix(quaternion)
        transform = geometry_msgs.msg.Transform()
        pose = geometry_msgs.msg.Pose()
        for vector in (transform.translation, pose.position):
            vector.x, vector.y, vector.z = origin
        for rotation in (transform.rotation, pose.orientation):
            rotation.x, rotation.y, rotation.z, rotation.w = quaternion
        stamped = geometry_msgs.msg.TransformStamped(transform=transform)
        for message in (transform, pose, stamped):
            np.testing.assert_allclose(transform_to_matrix(message), expected, atol=1e-12)


globals()[sys.argv[1]]()
print("done")
