"""Coated and layered bodies: elastic layers on a half-space or on a rigid base."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge.halfplane import ELEMENTS, Element
from fuge.halfspace import AREA_ELEMENTS, AreaElement


@dataclass(frozen=True, eq=False)
class Layers:
    """Elastic layers, from the surface down, on a half-space or on a rigid base.

    Parameters
    ----------
    thickness : array_like, shape (layers,), or float
        Thicknesses; length.
    young : array_like, shape (layers + 1,)
        Young's moduli, the last one of the half-space below the layers; ``inf``: a rigid base; force per length^2.
    poisson : array_like, shape (layers + 1,), or float
        Poisson's ratios, 0 .. 0.5.
    bonded : bool
        All interfaces are bonded. Otherwise they slide without friction, and do not come off.
    e_star_other : float
        E/(1 - nu^2) of the other body, a half-space; ``inf``: it is rigid.

    Attributes
    ----------
    e_star : float
        1/e_star = (1 - nu^2)/E of the top layer + 1/e_star_other: the modulus of short waves.

    Raises
    ------
    InputError
        A thickness or a modulus is not positive, a Poisson's ratio is out of range, or numbers do not fit together.
    """

    thickness: ArrayLike
    young: ArrayLike
    poisson: ArrayLike
    bonded: bool = True
    e_star_other: float = np.inf

    def __post_init__(self) -> None:
        # No waves: only the layers are checked.
        self.compliance([])

    def arguments(self) -> list[Any]:
        """The arguments of C functions that take layers: their number to e_star_other."""
        thickness = _arrays.vector("thickness", np.atleast_1d(_arrays.array("thickness", self.thickness)))
        materials = thickness.size + 1
        return [
            thickness.size,
            thickness,
            _arrays.spread("young", self.young, materials),
            _arrays.spread("poisson", self.poisson, materials),
            _arrays.flag("bonded", self.bonded),
            _arrays.number("e_star_other", self.e_star_other),
        ]

    @property
    def e_star(self) -> float:
        """The modulus of short waves; force per length^2."""
        _, _, young, poisson, _, other = self.arguments()
        return float(1.0 / ((1.0 - poisson[0] ** 2) / young[0] + 1.0 / other))

    def effective_modulus(self, radius: ArrayLike) -> NDArray[np.float64]:
        """Effective e_star of both bodies under round contacts of the radius a: dF/dd = 2 a modulus.

        It is that of the half-space on which a rigid flat punch of this radius is as stiff, and so a round punch of any
        profile with this contact radius, because it moves on as a flat one. For moduli 1 : 100 .. 100 : 1 and on a
        rigid base it is exact to 4e-6 for thicknesses from 0.1 radii on, to 1e-3 from 0.03 and to 5e-3 from 0.01 on,
        and never too large.

        Parameters
        ----------
        radius : array_like
            Of the contact; > 0; length.

        Returns
        -------
        ndarray of the same shape
            Force per length^2.

        Raises
        ------
        InputError
        """
        radii = _arrays.doubles("radius", radius)
        modulus = np.empty(radii.shape)
        arguments = [*self.arguments(), radii.size, radii, modulus]
        call("fuge_layered_modulus", *arguments, shapes={"radius": radii.shape})
        return modulus

    def compliance(self, q: ArrayLike) -> NDArray[np.float64]:
        """Displacement of the surface per pressure of waves, 2 T/(e_star q).

        Parameters
        ----------
        q : array_like
            2 pi over the lengths of the waves; 1/length.

        Raises
        ------
        InputError
        """
        waves = _arrays.doubles("q", q)
        compliance = np.empty(waves.shape)
        call("fuge_layered_waves", *self.arguments(), waves.size, waves, compliance)
        return compliance

    def halfplane_matrix(
        self, x: ArrayLike, width: ArrayLike, element: Element = "mean", *, symmetric: bool = False
    ) -> NDArray[np.float64]:
        """Influence matrix of cells in plane strain; the arguments are those of :func:`halfplane_matrix`."""
        centres = _arrays.vector("x", x)
        n = centres.size
        alpha = np.empty((n, n), order="F")
        widths = _arrays.spread("width", width, n)
        cells = [n, centres, widths, ELEMENTS.number(element), int(bool(symmetric))]
        call("fuge_layered_halfplane_matrix", *self.arguments(), *cells, alpha, n)
        return alpha

    def halfspace_matrix(
        self,
        x: ArrayLike,
        y: ArrayLike,
        width_x: ArrayLike,
        width_y: ArrayLike,
        element: AreaElement = "mean",
        *,
        symmetric_x: bool = False,
        symmetric_y: bool = False,
    ) -> NDArray[np.float64]:
        """Influence matrix of rectangles; the arguments are those of :func:`halfspace_matrix`."""
        centres = _arrays.vector("x", x)
        n = centres.size
        alpha = np.empty((n, n), order="F")
        cells = [
            n,
            centres,
            _arrays.vector("y", y, n),
            _arrays.spread("width_x", width_x, n),
            _arrays.spread("width_y", width_y, n),
            AREA_ELEMENTS.number(element),
            int(bool(symmetric_x)),
            int(bool(symmetric_y)),
        ]
        call("fuge_layered_halfspace_matrix", *self.arguments(), *cells, alpha, n)
        return alpha

    def ring_matrix(self, radius: ArrayLike) -> NDArray[np.float64]:
        """Influence matrix of rings about an axis; ``radius`` as in :func:`ring_matrix`."""
        radii = _arrays.vector("radius", radius)
        n = radii.size - 1
        alpha = np.empty((max(n, 0), max(n, 0)), order="F")
        call("fuge_layered_ring_matrix", *self.arguments(), n, radii, alpha, n)
        return alpha


def layers_of(layers: Any) -> list[Any]:
    """The arguments of C functions for a body of layers."""
    if not isinstance(layers, Layers):
        raise TypeError(
            f"layers must be Layers, not {type(layers).__name__}: a body of one material is "
            "Layers([], young, poisson), or a half-space, which has operators and fields of its own"
        )
    return layers.arguments()


@dataclass(frozen=True, eq=False)
class GradedLayers(Layers):
    """The layers of a body whose moduli vary over the depth, by :func:`graded_layers`; otherwise as :class:`Layers`.

    Attributes
    ----------
    error : float
        Estimate of the relative error of the displacement of the surface by a wave of pressure, of any length.
    """

    error: float = 0.0


def graded_layers(
    depth: ArrayLike,
    young: ArrayLike,
    poisson: ArrayLike,
    tolerance: float = 1e-4,
    *,
    max_layers: int = 2000,
    e_star_other: float = np.inf,
) -> GradedLayers:
    """Layers in place of moduli that vary over the depth.

    Layers are thin near the surface and where the moduli change fast; what is constant is one layer.

    Parameters
    ----------
    depth : array_like, shape (points,)
        From 0, the surface, down; two equal ones are a jump; length.
    young : array_like, shape (points,)
        Young's modulus at these depths, linear between them; below the last one lies a half-space of the last values.
        The last one may be ``inf`` after a jump: a rigid base. Force per length^2.
    poisson : array_like, shape (points,), or float
        Poisson's ratio, likewise; 0 .. 0.5.
    tolerance : float
        Relative error of the displacement of the surface by a wave of pressure, of any length; 1e-10 .. 0.1. 1e-3 and
        1e-4 take tens and hundreds of layers. The error is estimated by a third of the largest difference from half
        as many layers.
    max_layers : int
        The most layers.
    e_star_other : float
        E/(1 - nu^2) of the other body, a half-space; ``inf``: it is rigid.

    Returns
    -------
    GradedLayers
        With the estimated :attr:`GradedLayers.error`.

    Raises
    ------
    InputError
    LimitError
        The tolerance takes more layers; the message says how many.
    """
    depths = _arrays.vector("depth", depth)
    points, most = depths.size, _arrays.integer("max_layers", max_layers)
    moduli, ratios = _arrays.spread("young", young, points), _arrays.spread("poisson", poisson, points)
    layers = np.empty(1, dtype=np.intc)
    thickness, error = np.empty(max(most, 0)), np.empty(1)
    found_young, found_poisson = np.empty(thickness.size + 1), np.empty(thickness.size + 1)
    profile = [points, depths, moduli, ratios, _arrays.number("tolerance", tolerance), most]
    call("fuge_graded_layers", *profile, layers, thickness, found_young, found_poisson, error)
    n = int(layers[0])
    return GradedLayers(
        thickness[:n].copy(),
        found_young[: n + 1].copy(),
        found_poisson[: n + 1].copy(),
        e_star_other=e_star_other,
        error=float(error[0]),
    )


class CoatingLimits(NamedTuple):
    """Thicknesses of a coating, by :func:`coating_limits`.

    Attributes
    ----------
    thin : float
        Up to this thickness the coating is not felt; length.
    thick : float
        From this thickness on the body below it is not felt; length.
    """

    thin: float
    thick: float


def coating_limits(young: ArrayLike, poisson: ArrayLike, radius: float, share: float) -> CoatingLimits:
    """Below which thickness a bonded coating is not felt, and above which the body below it is not.

    Parameters
    ----------
    young : array_like, shape (2,)
        Young's moduli of the coating and of the half-space below it, ``inf`` if that is rigid; force per length^2.
    poisson : array_like, shape (2,), or float
        Their Poisson's ratios, 0 .. 0.5.
    radius : float
        Of the contact; > 0; length.
    share : float
        The largest relative change of :meth:`Layers.effective_modulus`, 1e-6 .. 1, that counts as not felt.

    Returns
    -------
    CoatingLimits
        ``thin`` is 0 on a rigid base, and ``inf`` if a coating is never felt; then ``thick`` is 0.

    Raises
    ------
    InputError
    """
    thin, thick = np.empty(1), np.empty(1)
    materials = _arrays.spread("young", young, 2), _arrays.spread("poisson", poisson, 2)
    numbers = _arrays.number("radius", radius), _arrays.number("share", share)
    call("fuge_coating_limits", *materials, *numbers, thin, thick)
    return CoatingLimits(float(thin[0]), float(thick[0]))
