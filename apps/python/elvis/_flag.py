"""The bits of a picture's flags."""

import enum


class Flag(enum.IntFlag):
    """What a bit of Picture.flags says of its pixel (scenes/buffers.md).

        undecided = (picture.flags & elvis.Flag.UNDECIDED) != 0
    """

    CONTOUR = 1
    CONTOUR_UNDECIDED = 2
    MESH_LINE = 4
    NEWTON_FAILURE = 8
    NAN = 16
    ISOSURFACE = 32
    ISOSURFACE_UNDECIDED = 64
    VOLUME_TOLERANCE = 128
    UNDECIDED = 256
    MESH_LINE_UNDECIDED = 512
    WORK_LIMIT = 1024
    ESTIMATED = 2048
    RANGE_TOO_FINE = 4096
    OVERLAP = 8192
    DOUBTS = (CONTOUR_UNDECIDED | NEWTON_FAILURE | ISOSURFACE_UNDECIDED | VOLUME_TOLERANCE | UNDECIDED | MESH_LINE_UNDECIDED
              | WORK_LIMIT | RANGE_TOO_FINE | OVERLAP)
    """All by which a picture says of a pixel that it may be wrong."""
