"""The structs of the C interface; a test compares them with the headers."""

from __future__ import annotations

import ctypes


class Options(ctypes.Structure):
    """fuge_options."""

    _fields_ = [
        ("method", ctypes.c_int),
        ("pivot_rule", ctypes.c_int),
        ("max_iterations", ctypes.c_int),
        ("keep_history", ctypes.c_int),
        ("reserved_int", ctypes.c_int * 4),
        ("tolerance", ctypes.c_double),
        ("reserved", ctypes.c_double * 7),
    ]


class InfoStruct(ctypes.Structure):
    """fuge_info."""

    _fields_ = [
        ("status", ctypes.c_int),
        ("iterations", ctypes.c_int),
        ("contacts", ctypes.c_int),
        ("products", ctypes.c_int),
        ("preconditionings", ctypes.c_int),
        ("reserved_int", ctypes.c_int * 3),
        ("residual", ctypes.c_double),
        ("force_error", ctypes.c_double),
        ("reserved", ctypes.c_double * 6),
    ]


class SmoothReport(ctypes.Structure):
    """fuge_smooth_report."""

    _fields_ = [
        ("iterations", ctypes.c_int),
        ("coefficients", ctypes.c_int),
        ("reserved_int", ctypes.c_int * 6),
        ("left", ctypes.c_double),
        ("right", ctypes.c_double),
        ("half_width", ctypes.c_double),
        ("force", ctypes.c_double),
        ("moment", ctypes.c_double),
        ("approach", ctypes.c_double),
        ("tilt", ctypes.c_double),
        ("residual", ctypes.c_double),
        ("end_error", ctypes.c_double),
        ("pressure_error", ctypes.c_double),
        ("reserved", ctypes.c_double * 8),
    ]


class RoundReport(ctypes.Structure):
    """fuge_round_report."""

    _fields_ = [
        ("iterations", ctypes.c_int),
        ("coefficients", ctypes.c_int),
        ("reserved_int", ctypes.c_int * 6),
        ("radius", ctypes.c_double),
        ("load", ctypes.c_double),
        ("approach", ctypes.c_double),
        ("residual", ctypes.c_double),
        ("radius_error", ctypes.c_double),
        ("pressure_error", ctypes.c_double),
        ("reserved", ctypes.c_double * 8),
    ]


class StressPeakStruct(ctypes.Structure):
    """fuge_stress_peak."""

    _fields_ = [
        ("location", ctypes.c_int),
        ("reserved_int", ctypes.c_int * 7),
        ("value", ctypes.c_double),
        ("place", ctypes.c_double * 3),
        ("tensor", ctypes.c_double * 6),
        ("reserved", ctypes.c_double * 6),
    ]


STRUCTS: dict[str, type[ctypes.Structure]] = {
    "fuge_options": Options,
    "fuge_info": InfoStruct,
    "fuge_smooth_report": SmoothReport,
    "fuge_round_report": RoundReport,
    "fuge_stress_peak": StressPeakStruct,
}
