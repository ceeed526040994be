"""Images, point clouds, laser scans and transforms as NumPy arrays.

NumPy is not needed by the rest of the library: ``pip install aioros1[numpy]``.
"""

from __future__ import annotations

from aioros1.contrib._images import array_to_image, image_to_array
from aioros1.contrib._point_clouds import (
    array_to_pointcloud2,
    laserscan_to_points,
    pointcloud2_to_array,
)
from aioros1.contrib._transforms import transform_to_matrix

__all__ = [
    "array_to_image",
    "array_to_pointcloud2",
    "image_to_array",
    "laserscan_to_points",
    "pointcloud2_to_array",
    "transform_to_matrix",
]
