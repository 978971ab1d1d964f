"""Load cases of a structure with links: forces, displacements, reactions, and why a case fails."""

from __future__ import annotations

import ctypes
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import MESSAGE_LENGTH
from fuge._library import function
from fuge._messages import in_python
from fuge.cases import Cases, reported, warn_of_cases
from fuge.errors import Status, Warning, finish, warn
from fuge.links import listed

if TYPE_CHECKING:
    from fuge.body import Body

Doubles = NDArray[np.float64]


def solve_link_cases(
    body: Body, loads: ArrayLike, supports: ArrayLike | None, names: Sequence[str] | None, prove: bool
) -> Cases:
    """What :meth:`Body.solve_cases` returns, and warns of."""
    forces = _arrays.doubles("loads", loads, (None, body.degrees))
    number = len(forces)
    moved = None if supports is None else _arrays.doubles("supports", supports, (number, body._fixed.size))
    solver, links = body._pose()
    _warn_of_idle(body, links.names, body._settled[None] if moved is None else moved)
    displacement, resultant = np.empty((number, body._n)), np.empty((number, body._mode_count()))
    refused = np.zeros(number, dtype=np.intc)
    arguments = number, forces, moved, displacement, resultant, refused
    code, message, reasons = _call_cases(body, "fuge_body_get_cases", number, arguments)
    # Of loads that are refused the cases tell.
    finish(min(code, 0), message)
    found = solver._solve_cases(displacement + links.gap, resultant if resultant.size else None, names, prove)
    found = replace(found, links=links.names, supports=body._support_names())
    for k in np.flatnonzero(found.status):
        status = int(refused[k] or found.status[k])
        if refused[k]:
            told = reasons[k]
        elif status == Status.ERR_NO_EQUILIBRIUM:
            told = _collapse(body, forces[k])
        else:
            told = body._names.in_message(found.message[k], links.names, lambda mode: _motion(body, mode))
        found = reported(found, int(k), Status(status), told)
    balanced = _recovered(body, forces, moved, found)
    warn_of_cases(found)
    return balanced


def _recovered(body: Body, forces: Doubles, moved: Doubles | None, found: Cases) -> Cases:
    """The cases with displacements and reactions; a warning if some are out of balance."""
    number, displacement = len(forces), np.empty(forces.shape)
    arguments = number, forces, moved, found.force, found.motion, displacement, found.status
    code, message, remarks = _call_cases(body, "fuge_body_recover_cases", number, arguments)
    finish(code, message)
    reaction = body.reaction(displacement, found.force, forces)
    reaction[found.status < 0] = np.nan
    done = replace(found, displacement=displacement, reaction=reaction)
    for k, remark in enumerate(remarks if code > 0 else ()):
        if remark and found.status[k] == Status.DONE:
            done = reported(done, k, Status(code), remark)
    return done


def _call_cases(body: Body, name: str, number: int, arguments: tuple[Any, ...]) -> tuple[int, str, list[str]]:
    """Call a function of all cases, and read what it says of each."""
    text, told = ctypes.create_string_buffer(MESSAGE_LENGTH + 1), []
    with body._handle.use() as pointer:
        code = function(name)(pointer, *arguments)
        message = in_python(body._read_message(pointer), body._shapes)
        for k in range(number if code >= 0 else 0):
            function("fuge_body_case_message")(pointer, k, text, MESSAGE_LENGTH + 1)
            told.append(body._named(in_python(text.value.decode(errors="replace"), {})))
    return code, body._named(message), told


def _warn_of_idle(body: Body, names: Sequence[str], moved: Doubles) -> None:
    """Tell of links whose ends supports hold that move in no case."""
    openings, free = body._openings(), np.ones(body.degrees, dtype=bool)
    free[body._fixed] = False
    acts = np.diff(openings[:, free].indptr) > 0
    acts |= np.any(openings[:, body._fixed] @ moved.T != 0.0, axis=1)
    idle = [name for name, act in zip(names, acts) if not act]
    if idle:
        its, it = ("its", "it") if len(idle) == 1 else ("their", "them")
        reason = f"supports of the body hold {its} ends, whatever the loads are"
        remedy = f"free these degrees of freedom, or leave {it} out"
        warn(Warning(f"{listed(idle)} can never act: {reason}; {remedy}", Status.DONE))


def _collapse(body: Body, load: Doubles) -> str:
    """Why a load has no equilibrium: which links open, and what moves most."""
    u = body.mechanism(load)
    links = body._links
    assert links is not None
    # Without nodes the words are those of the links, and of the degree of freedom.
    words = links.describe(u, [[0.0, 0.0]], [[-1, -1]]).split("; the structure")[0]
    return f"nothing balances the load: {words}, and {body._names.most(u)} moves most; Body.mechanism gives the motion"


def _motion(body: Body, mode: int) -> str:
    """What a motion of the structure moves."""
    force, motions = np.zeros(body._n), np.zeros((2, body._mode_count()))
    motions[1, mode] = 1.0
    still, moved = (body.recover(force, motion) for motion in motions)
    return f"which moves {body._names.most(moved - still)} most"
