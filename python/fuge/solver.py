"""Contact problems."""

from __future__ import annotations

import ctypes
import weakref
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, Callable, ContextManager, Iterator, Literal, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import MESSAGE_LENGTH, Owner, end_call, interruptible, new_handle, progress_callback
from fuge._library import function, struct
from fuge._messages import in_python
from fuge._words import Words
from fuge.cases import Cases, checked_names, warn_of_cases
from fuge.cells import known_cells
from fuge.contact import Contact, Derivative, History, Info, info_of, no_solver
from fuge.design import Gradients, WantedContact
from fuge.errors import GridWarning, Status, error, warn
from fuge.operators import DenseOperator, Operator
from fuge.path import Path, check_matrix, collect_path
from fuge.proof import Proof, range_of_largest

Method = Literal["auto", "tableau", "active_set", "iterative"]
PivotRule = Literal["paper", "most_negative", "greatest_decrease"]

METHODS = Words("method", Method)
PIVOT_RULES = Words("pivot_rule", PivotRule, paper="PAPER_RULE")

Progress = Callable[[int, float, int], Any]

# Threads of a solve: as many as the process may use cores.
ALL_CORES = 0


def chosen_options(
    method: Method | None,
    pivot_rule: PivotRule | None = None,
    max_iterations: int | None = None,
    keep_history: bool | None = None,
    tolerance: float | None = None,
    threads: int = ALL_CORES,
) -> Any:
    """fuge_options: the library's defaults, but for the threads and for what is not None."""
    options = struct("fuge_options")
    function("fuge_default_options")(ctypes.byref(options))
    if method is not None:
        options.method = METHODS.number(method)
    if pivot_rule is not None:
        options.pivot_rule = PIVOT_RULES.number(pivot_rule)
    if max_iterations is not None:
        options.max_iterations = _arrays.integer("max_iterations", max_iterations)
    if keep_history is not None:
        options.keep_history = int(bool(keep_history))
    if tolerance is not None:
        options.tolerance = _arrays.number("tolerance", tolerance)
    options.threads = _arrays.integer("threads", threads)
    return options


class Solver(Owner):
    """A contact problem and its solution, for one solve after the other.

    The parts of the problem are set each on its own: gaps (:meth:`set_gap`), exclusions (:meth:`set_excluded`),
    springs at the points (:meth:`set_compliance`), limits of the forces (:meth:`set_limits`), and motions
    (:meth:`set_load`, :meth:`set_approach` or :meth:`set_modes`). A solve starts from the contact of the one before.
    Calls from several threads wait for each other.

    Parameters
    ----------
    operator : Operator or array_like, shape (n, n)
        How the bodies deform; an influence matrix becomes a :class:`DenseOperator`.
    method : {'auto', 'tableau', 'active_set', 'iterative'}, optional
        The engine. 'auto' takes the active set for a matrix, the tableau if the history is kept, and the iteration
        for any other operator.
    pivot_rule : {'paper', 'most_negative', 'greatest_decrease'}, optional
        The pivot rule of the tableau.
    max_iterations : int, optional
        Limit of pivots or contact sets.
    keep_history : bool, optional
        Keep all steps of the tableau for :meth:`history`.
    tolerance : float, optional
        Largest residual without a warning.
    threads : int
        Threads that share the work of a solve and of its derivatives; 0, the default, for as many as the process may
        use cores. No result depends on it. Use 1 where other processes or threads are at work.
    progress : callable, optional
        See :meth:`set_progress`.

    Raises
    ------
    InputError
        An option has an invalid value.
    """

    _message_function = "fuge_solver_message"

    def __init__(
        self,
        operator: Operator | ArrayLike,
        *,
        method: Method | None = None,
        pivot_rule: PivotRule | None = None,
        max_iterations: int | None = None,
        keep_history: bool | None = None,
        tolerance: float | None = None,
        threads: int = ALL_CORES,
        progress: Progress | None = None,
    ) -> None:
        self.operator = operator if isinstance(operator, Operator) else DenseOperator(operator)
        self._shape: tuple[int, ...] = self.operator.grid or (self.n,)
        options = chosen_options(method, pivot_rule, max_iterations, keep_history, tolerance, threads)
        read = self.operator._handle
        arguments = [read.pointer, ctypes.byref(options)]
        self._handle = new_handle("solver", "fuge_solver_new", "fuge_solver_free", *arguments, needs=[read])
        self._found: weakref.ref[Contact] | None = None
        # What load cases change: gaps and plays; for each motion, whether it is prescribed, and its value.
        self._gaps: tuple[NDArray[np.float64] | None, NDArray[np.float64] | None] = None, None
        self._motions: list[tuple[bool, float]] = []
        self.set_progress(progress)

    def __repr__(self) -> str:
        return f"<Solver: {self.n} points, {self.mode_count} motions, {self.operator!r}>"

    @property
    def n(self) -> int:
        """Number of contact points."""
        return self.operator.n

    def set_progress(self, progress: Progress | None) -> None:
        """Call ``progress(iteration, residual, contacts)`` in each iteration of a solve; None for no such calls.

        If it returns a true value the solve ends with :class:`CancelledError`. An exception in it ends the solve, and
        is raised there. Ctrl-C ends a solve in the main thread with or without a progress function.
        """
        if progress is not None and not callable(progress):
            raise TypeError(f"progress must be callable, not {type(progress).__name__}")
        called = progress_callback(progress)
        self._call("fuge_set_progress", called, None)
        self._handle.keep_only(called)

    # ---- the problem

    def set_gap(self, gap: ArrayLike, gap_upper: ArrayLike | None = None) -> None:
        """Set the initial gaps, and the play of points with two stops.

        Parameters
        ----------
        gap : array_like, shape (n,), or that of the operator's grid, or float
            Initial gaps, including those that external loads cause; length. Results have this shape.
        gap_upper : array_like of the same shape, or float, optional
            Play between the two stops of a point: infinity where contact is one-sided, as it is everywhere without
            this argument; 0 where the point is tied; length.

        Raises
        ------
        InputError
            A shape does not fit, a gap is not finite, or gap_upper is negative.
        """
        values = self._points("gap", gap)
        shape = self._shape_of(gap)
        upper = None if gap_upper is None else self._points("gap_upper", gap_upper)
        shapes = {"gap": shape, "gap_upper": shape if gap_upper is None else np.shape(gap_upper)}
        self._call("fuge_set_gap", values, upper, shapes=shapes)
        self._gaps = values.copy(), None if upper is None else upper.copy()
        self._shape = shape
        self._shapes = {"point": shape}

    def set_excluded(self, excluded: ArrayLike | None) -> None:
        """Let points carry no force, those where the booleans are true; None: no such points.

        Their gaps are computed nevertheless, and may be negative.
        """
        chosen = None
        if excluded is not None:
            found = _arrays.flags("excluded", excluded)
            self.operator._check_shape("excluded", found.shape)
            chosen = found.reshape(-1)
        self._call("fuge_set_excluded", chosen)

    def set_compliance(self, compliance: ArrayLike | None) -> None:
        """Put a spring between the bodies at each point: a gasket, a bed, a member.

        Every method knows them. Of a matrix the solver keeps a copy with the springs, unless the iteration solves.

        Parameters
        ----------
        compliance : array_like of the shape of the gaps, or float, or None
            By how much a force of 1 shortens the spring, not negative; length per force. None: no springs.

        Raises
        ------
        InputError
            A shape does not fit, or a compliance is negative or not finite.
        """
        self._call("fuge_set_compliance", *self._laws(compliance=compliance), shapes=self._law_shapes())

    def set_limits(self, limit: ArrayLike | None = None, limit_upper: ArrayLike | None = None) -> None:
        """Limit the forces: to hardness times area, to the yield force of a support, or as where a clamp slips.

        A point whose force has reached its limit gives way: its gap may be negative then, at the upper stop greater
        than the play.

        Parameters
        ----------
        limit : array_like of the shape of the gaps, or float, optional
            Limit of the force at the lower stop, not negative; force. Infinity, or without this argument: none.
        limit_upper : array_like of the shape of the gaps, or float, optional
            Likewise, of the size of the force at the upper stop; for a tied point, of a pulling force.

        Raises
        ------
        InputError
            A shape does not fit, or a limit is negative or NaN.
        """
        values = self._laws(limit=limit, limit_upper=limit_upper)
        self._call("fuge_set_limits", *values, shapes=self._law_shapes())

    def set_load(self, load: float) -> None:
        """Let the bodies approach each other by one translation, under a load that is not negative; force."""
        self._call("fuge_set_load", _arrays.number("load", load))
        self._motions = [(False, float(load))]

    def set_approach(self, approach: float) -> None:
        """Prescribe by how much the bodies approach each other; length. The load is then a result."""
        self._call("fuge_set_approach", _arrays.number("approach", approach))
        self._motions = [(True, float(approach))]

    def set_modes(self, modes: ArrayLike, resultant: ArrayLike) -> None:
        """Let the bodies move by several rigid motions, all free.

        Parameters
        ----------
        modes : array_like, shape (n, m) or that of the grid followed by m
            Column j says how far each point closes per unit of motion j. m = 0: no motions.
        resultant : array_like, shape (m,)
            Resultant of the forces for each motion: the sum of the forces times the column.
        """
        found = _arrays.array("modes", modes)
        grid = self.operator.grid
        _arrays.check_shape("modes", found.shape, *([] if grid is None else [(*grid, "m")]), (self.n, "m"))
        m = found.shape[-1]
        matrix = _arrays.columns("modes", found.reshape(self.n, m), (self.n, m))
        forces = _arrays.vector("resultant", resultant, m)
        self._call("fuge_set_modes", m, matrix, forces, shapes={"point": found.shape[:-1]})
        self._motions = [(False, force) for force in forces.tolist()]

    def set_motion(self, mode: int, motion: float) -> None:
        """Prescribe one of the motions, which count from 0, or change its value."""
        self._set_motion(_arrays.integer("mode", mode), True, _arrays.number("motion", motion))

    def set_resultant(self, mode: int, resultant: float) -> None:
        """Let a motion be free under a resultant of either sign, or change the resultant."""
        self._set_motion(_arrays.integer("mode", mode), False, _arrays.number("resultant", resultant))

    def set_motion_stiffness(self, mode: int, stiffness: float) -> None:
        """Put one of the motions on a spring, which takes its part of the resultant; 0: no spring.

        The springs go with the motions, when these are set anew.
        """
        values = _arrays.integer("mode", mode), _arrays.number("stiffness", stiffness)
        self._call("fuge_set_motion_stiffness", *values)

    def _set_motion(self, mode: int, prescribed: bool, value: float) -> None:
        self._call("fuge_set_motion" if prescribed else "fuge_set_resultant", mode, value)
        self._motions[mode] = prescribed, value

    @property
    def mode_count(self) -> int:
        """Number m of rigid motions of the problem."""
        return self._counts("fuge_get_mode_count")[0]

    # ---- the solution

    def solve(self) -> Contact:
        """Solve the problem.

        Returns
        -------
        Contact

        Warns
        -----
        ResidualWarning
            The residual is above the tolerance.
        NotUniqueWarning
            Forces, or a motion that the contact does not resist, are not unique.
        IllConditionedWarning
            The forces may be far off.
        GridWarning
            The contact reaches the rim of a half-space's grid.

        Raises
        ------
        CallOrderError
            Gaps or motions have not been set.
        EquilibriumError
            No contact forces can be in equilibrium with the load.
        MatrixError
            The influence matrix is not positive definite.
        InputError
            Modes depend on each other.
        LimitError, UnsupportedError, CallbackError, CancelledError
        """
        contact, code = self._solve()
        end_call(code, lambda: contact.message)
        if code == 0 and contact.message:
            warn(GridWarning(f"{contact.message}; if they do, ignore fuge.GridWarning (module warnings)", Status.DONE))
        return contact

    def _solve(self) -> tuple[Contact, int]:
        """The solution and the status of the call, which is no error."""
        with interruptible(), self._reading(), self._handle.use() as pointer:
            self._found = None
            code = function("fuge_solve")(pointer)
            message = in_python(self._read_message(pointer), self._shapes)
            end_call(min(code, 0), lambda: message)
            return self._contact(pointer, message), code

    def solve_cases(
        self,
        gap: ArrayLike | None = None,
        load: ArrayLike | None = None,
        *,
        names: Sequence[str] | None = None,
        prove: bool = False,
    ) -> Cases:
        """Solve load cases that differ in gaps and loads only, each as :meth:`solve` would, but in less time.

        Parameters
        ----------
        gap : array_like, shape (cases, n) or (cases, ...) with that of the operator's grid, optional
            Gaps of each case, displacements by its external loads included; length. Without it those of
            :meth:`set_gap`.
        load : array_like, shape (cases, m), or (cases,) if m = 1, optional
            Resultants of the motions, and motions that are prescribed. Without it those of the problem. One of both
            is needed.
        names : sequence of str, optional
            Of the cases, for messages and tables; otherwise 'load case 0' and so on.
        prove : bool
            Bound the errors of all forces, gaps and motions too, `proof` of the result, by :meth:`prove`: each case is
            solved once more by itself, from its contact set.

        Returns
        -------
        Cases
            A row for each case. A case that fails harms no other: its row is NaN.

        Warns
        -----
        CasesWarning
            Some cases failed or have a warning; see `status` and `message` of the result.
        NotProvedWarning
            Bounds of some cases are infinite.

        Raises
        ------
        CallOrderError
            Gaps or motions have not been set.
        InputError
            A shape does not fit, or there is no case.
        CancelledError
        """
        cases = self._solve_cases(gap, load, names, prove)
        warn_of_cases(cases)
        return cases

    def _solve_cases(
        self, gap: ArrayLike | None, load: ArrayLike | None, names: Sequence[str] | None, prove: bool
    ) -> Cases:
        """The solutions of load cases, without warnings."""
        m = self.mode_count
        gaps = None if gap is None else self._case_gaps(_arrays.array("gap", gap))
        loads = None if load is None else _arrays.array("load", load)
        if loads is not None:
            loads = _arrays.doubles("load", loads.reshape(-1, 1) if loads.ndim == 1 and m == 1 else loads, (None, m))
        sizes = [len(given) for given in (gaps, loads) if given is not None]
        if not sizes or sizes[0] != sizes[-1]:
            raise error(Status.ERR_SIZE, "load cases need gap or load, or both with a row for each case")
        number = sizes[0]
        called = checked_names([f"load case {k}" for k in range(number)] if names is None else names, number)
        self._found = None
        force, found = np.full((number, self.n), np.nan), np.full((number, self.n), np.nan)
        motion, status = np.full((number, m), np.nan), np.zeros(number, dtype=np.intc)
        state = np.zeros((number, self.n), dtype=np.intc)
        infos, messages = [], []
        with interruptible(), self._reading(), self._handle.use() as pointer:
            code = function("fuge_solve_cases")(pointer, number, gaps, loads, force, found, motion, status)
            message = in_python(self._read_message(pointer), self._shapes)
            end_call(min(code, 0), lambda: message)
            text = ctypes.create_string_buffer(MESSAGE_LENGTH + 1)
            for k in range(number):
                report = struct("fuge_info")
                self._get_case("fuge_get_case_states", pointer, k, state[k])
                self._get_case("fuge_get_case_info", pointer, k, ctypes.byref(report))
                self._get_case("fuge_case_message", pointer, k, text, MESSAGE_LENGTH + 1)
                infos.append(info_of(report))
                messages.append(in_python(text.value.decode(errors="replace"), self._shapes))
        shape = (number, *self._shape)
        results = force.reshape(shape), found.reshape(shape), motion, state.reshape(shape), status
        cases = Cases(*results, tuple(infos), tuple(messages), names=called)
        return replace(cases, proof=self._prove_cases(cases, gaps, loads)) if prove else cases

    def _prove_cases(
        self, cases: Cases, gaps: NDArray[np.float64] | None, loads: NDArray[np.float64] | None
    ) -> tuple[Proof | None, ...]:
        """Bounds for each case, whose row becomes the solution that they are of; the problem remains as it was."""
        before = self._gaps[0], [value for _, value in self._motions]
        proofs: list[Proof | None] = []
        try:
            for k, status in enumerate(cases.status):
                if status < 0:
                    proofs.append(None)
                    continue
                self._pose(None if gaps is None else gaps[k], None if loads is None else loads[k].tolist())
                contact, _ = self._solve()
                cases.force[k], cases.gap[k], cases.motion[k] = contact.force, contact.gap, contact.motion
                cases.state[k] = contact.state
                proofs.append(self._proof(contact)[0])
        finally:
            self._pose(*before)
        return tuple(proofs)

    def _pose(self, gap: NDArray[np.float64] | None, values: Sequence[float] | None) -> None:
        """Set gaps and values of the motions, those of a load case, if they are given."""
        if gap is not None:
            self._call("fuge_set_gap", gap, self._gaps[1])
        for mode, value in enumerate(values or ()):
            self._set_motion(mode, self._motions[mode][0], value)

    def _take_links(self, gap: NDArray[np.float64], play: NDArray[np.float64] | None) -> None:
        """Know the problem that the library has posed of links, all of whose motions are free."""
        self._found = None
        self._gaps, self._motions = (gap, play), [(False, 0.0)] * self.mode_count

    def _case_gaps(self, gap: NDArray[Any]) -> NDArray[np.float64]:
        grid = self.operator.grid
        shapes = [("cases", self.n)] if grid is None else [("cases", *grid), ("cases", self.n)]
        _arrays.check_shape("gap", gap.shape, *shapes)
        return _arrays.doubles("gap", gap.reshape(-1, self.n), (None, self.n))

    def reset(self) -> None:
        """Forget results, contact set and history: the next solve starts from scratch."""
        self._call("fuge_reset")

    @property
    def info(self) -> Info:
        """Report of the last solve, failed or not."""
        report = struct("fuge_info")
        self._call("fuge_get_info", ctypes.byref(report))
        return info_of(report)

    def derivative(self, gap_change: ArrayLike | None = None, load_change: ArrayLike | None = None) -> Derivative:
        """Derivative of the last solution in a direction.

        With ``load_change=1`` alone the contact stiffness is ``1/derivative.motion[0]``.

        Parameters
        ----------
        gap_change : array_like, shape (n,) or that of the grid, optional
            Changes of the gaps.
        load_change : float, or array_like of shape (m,), optional
            Change of the load; with several motions those of the resultants, and of the motions that are prescribed.

        Raises
        ------
        CallOrderError
            There is no solution of the present problem.
        EquilibriumError
            The contact does not resist what the changes load.
        """
        gaps = None if gap_change is None else self._points("gap_change", gap_change)
        with self._alone() as (pointer, m):
            loads = None if load_change is None else _motions("load_change", load_change, m)
            force, gap, motion = np.empty(self._shape), np.empty(self._shape), np.empty(m)
            code = function("fuge_get_derivatives")(pointer, gaps, loads, force, gap, motion)
            end_call(code, lambda: self._read_message(pointer), self._shapes)
        return Derivative(force, gap, motion)

    def vjp(
        self,
        *,
        force: ArrayLike | None = None,
        gap: ArrayLike | None = None,
        motion: ArrayLike | None = None,
        pressure: ArrayLike | None = None,
    ) -> Gradients:
        """Gradient of an objective J at the last solution by all data of the problem: its vector-Jacobian product.

        One adjoint solve, in the time of one :meth:`derivative`, whatever the number of data; exact as long as the
        contact set does not change. The arguments are the partial derivatives of J by what the contact has; those
        that are left out are zero.

        Parameters
        ----------
        force : array_like, shape (n,) or that of the grid, or float, optional
            dJ/dforce, by ``contact.force``.
        gap : array_like of the same shape, or float, optional
            dJ/dgap, by ``contact.gap``, the gaps under load.
        motion : float, or array_like of shape (m,), optional
            dJ/dmotion, by ``contact.motion``; with one translation by ``contact.approach``.
        pressure : array_like, shape as of force, or float, optional
            dJ/dpressure, by ``contact.pressure``, added to that by the forces.

        Returns
        -------
        Gradients

        Warns
        -----
        KinkWarning
            Points lie on the border between two states, so that J has a kink; see `at_kink`. Not if the solve had a
            warning, which holds for the gradient too.

        Raises
        ------
        CallOrderError
            There is no solution of the present problem.
        EquilibriumError
            J depends on a motion that the contact does not resist.
        InputError
            A shape does not fit, a weight is not finite, or the operator does not know the cells of its points.

        Examples
        --------
        >>> solver = fuge.Solver([[0.2, 0.1], [0.1, 0.2]])
        >>> solver.set_gap([0.0, 1.0])
        >>> solver.set_load(2.0)
        >>> contact = solver.solve()
        >>> solver.vjp(motion=1.0)
        <Gradients: by 2 gaps up to 1, load 0.2, log_modulus -0.4, 0 points at a kink>
        """
        return self._vjp(None, force, gap, motion, pressure)

    def _vjp(
        self,
        contact: Contact | None,
        force: ArrayLike | None,
        gap: ArrayLike | None,
        motion: ArrayLike | None,
        pressure: ArrayLike | None,
    ) -> Gradients:
        """The gradient at `contact`, which must be the last solution, or at the last solution."""
        by_gap = None if gap is None else self._points("gap", gap)
        by_force = self._force_weights(force, pressure)
        with self._alone(contact) as (pointer, m):
            by_motion = None if motion is None else _motions("motion", motion, m)
            gaps, compliance, gap_upper, limit, limit_upper = (np.empty(self._shape) for _ in range(5))
            load, motion_stiffness = np.empty(m), np.empty(m)
            log_modulus, at_kink = np.empty(1), np.empty(self._shape, dtype=np.intc)
            results = gaps, load, compliance, motion_stiffness, gap_upper, limit, limit_upper
            code = function("fuge_get_gradients")(pointer, by_force, by_gap, by_motion, *results, log_modulus, at_kink)
            message = in_python(self._read_message(pointer), self._shapes).replace("_weight", "")
            # Other warnings are those of the solve, which has given them.
            end_call(min(code, 0) if code != Status.WARN_KINK else code, lambda: message)
        return Gradients(*results, float(log_modulus[0]), at_kink != 0)

    def gap_for_pressure(
        self, pressure: ArrayLike | None = None, *, force: ArrayLike | None = None, clearance: float = 0.0
    ) -> WantedContact:
        """The initial gaps that give a wanted pressure, or wanted forces, by one product.

        Motions and laws of the solver count, its gaps and resultants do not, and stay: pass what is found to
        :meth:`set_gap` and :meth:`set_load`. A free translation takes up a constant: where it is the only motion the
        smallest gap is 0. Other free motions will be 0. On a surface that is periodic in all directions a prescribed
        approach does not say how large an even pressure is in whole contact: prescribe the load there.

        Parameters
        ----------
        pressure : array_like, shape (n,) or that of the grid, or float, optional
            Wanted force over the area of a cell, for operators of equal cells; force per length^2.
        force : array_like, shape (n,) or that of the grid, or float, optional
            In place of it: wanted forces.
        clearance : float
            Gap that is left under load where no force is wanted; length. With 0 these points just touch.

        Returns
        -------
        WantedContact

        Warns
        -----
        UnreachableWarning
            A point cannot have what is wanted: it cannot pull at a lower stop, nor have more than its limit, nor
            anything where excluded. The gaps are those for the nearest force that it can have.

        Raises
        ------
        InputError
            A shape does not fit, a value is not finite, the clearance is negative, neither pressure nor force is
            given or both are, or the operator does not know the cells of its points.
        CallbackError

        Examples
        --------
        >>> solver = fuge.Solver([[0.2, 0.1], [0.1, 0.2]])
        >>> solver.gap_for_pressure(force=[2.0, 0.0], clearance=0.5)
        <WantedContact: gaps 0 to 0.7, load 2>
        """
        if pressure is not None and force is None:
            area = known_cells(self.operator.cells).size
            wanted, shape = area * self._points("pressure", pressure), self._shape_of(pressure)
        elif force is not None and pressure is None:
            wanted, shape = self._points("force", force), self._shape_of(force)
        else:
            raise error(Status.ERR_OPTION, "give one of pressure and force")
        least = _arrays.number("clearance", clearance)
        gap, reached = np.empty(shape), np.empty(shape)
        with self._alone() as (pointer, m):
            resultant = np.empty(m)
            code = function("fuge_gap_for_pressure")(pointer, wanted, least, gap, reached, resultant)
            end_call(code, lambda: self._read_message(pointer), {"force": shape, "point": shape})
        return WantedContact(gap, reached, resultant, self.operator.cells)

    def prove(self) -> Proof:
        """Bounds of the error of the last solution: of each force, gap and motion, rounding included.

        By a matrix for any problem, in the time of a few solves from cold and with memory for three copies of the
        matrix, of which one triangle counts. By a half-plane or half-space for one translation, free or prescribed,
        in the time of two products. Operators of other kinds prove nothing.

        Returns
        -------
        Proof

        Warns
        -----
        NotProvedWarning
            Bounds are infinite; the message says why.

        Raises
        ------
        CallOrderError
            There is no solution of the present problem.
        OutOfMemoryError

        Examples
        --------
        >>> solver = fuge.Solver([[0.2, 0.1], [0.1, 0.2]])
        >>> solver.set_gap([0.0, 1.0])
        >>> solver.set_load(2.0)
        >>> contact = solver.solve()
        >>> proof = solver.prove()
        >>> bool(proof.force_bound.max() < 1e-15), proof.proved
        (True, array([ True,  True]))
        """
        return self._prove(None)

    def _prove(self, contact: Contact | None) -> Proof:
        """The proof of `contact`, which must be the last solution, or of the last solution."""
        proof, code = self._proof(contact)
        end_call(code, lambda: proof.message)
        return proof

    def _proof(self, contact: Contact | None) -> tuple[Proof, int]:
        """The proof and the status of the call, which is no error."""
        with self._alone(contact) as (pointer, m):
            force, proved = np.empty(self._shape), np.empty(self._shape, dtype=np.intc)
            force_bound, gap_bound, motion_bound = np.empty(self._shape), np.empty(self._shape), np.empty(m)
            code = function("fuge_prove")(pointer, force_bound, gap_bound, motion_bound, proved)
            message = in_python(self._read_message(pointer), self._shapes)
            if code >= 0:
                self._get("fuge_get_force", pointer, force)
            end_call(min(code, 0), lambda: message)
        largest = range_of_largest(force, force_bound)
        return Proof(force_bound, gap_bound, motion_bound, proved != 0, largest, message), code

    def history(self) -> History:
        """Steps of the tableau, kept if the solver was made with ``keep_history=True``."""
        available = np.empty(1, dtype=np.intc)
        self._call("fuge_get_history", 0, 0, None, None, available)
        steps = int(available[0])
        basis = np.empty((steps, self.n + self.mode_count), dtype=np.intc)
        z = np.empty(steps)
        self._call("fuge_get_history", 0, steps, basis, z, available)
        return History(basis, z)

    def follow_path(self, finish: ArrayLike) -> Path:
        """The exact course of the contact from the present problem to one with other loads, without load steps.

        Springs at the points and on motions and limits of the forces hold all along: a point that comes to its limit
        or leaves it has an entry.

        Parameters
        ----------
        finish : float, or array_like of shape (m,)
            Resultants of free motions and prescribed motions at the end; all change linearly with a parameter from
            0 to 1.

        Raises
        ------
        EquilibriumError
            Equilibrium ends on the path, also where the limits carry no more; the message has the parameter.
        UnsupportedError
            The operator has no matrix.
        """
        check_matrix(self.operator)
        m = self.mode_count
        end = _motions("finish", finish, m)
        return collect_path(self.n, m, lambda *results: self._call("fuge_follow_path", end, *results))

    @contextmanager
    def _alone(self, contact: Contact | None = None) -> Iterator[tuple[ctypes.c_void_p, int]]:
        """The pointer and the number of motions, which no other thread changes meanwhile.

        An error unless `contact`, if it is given, is the last solution.
        """
        count = np.empty(1, dtype=np.intc)
        with interruptible(), self._reading(), self._handle.use() as pointer:
            if contact is not None and not self._has_found(contact):
                raise no_solver()
            self._get("fuge_get_mode_count", pointer, count)
            yield pointer, int(count[0])

    def _reading(self) -> ContextManager[Any]:
        """A context in which no call can change the operator; the caller may have closed it."""
        return self.operator._handle.reading(closed=True)

    def _contact(self, pointer: ctypes.c_void_p, message: str) -> Contact:
        count = np.empty(1, dtype=np.intc)
        report = struct("fuge_info")
        self._get("fuge_get_mode_count", pointer, count)
        force, gap = np.empty(self._shape), np.empty(self._shape)
        motion, resultant = np.empty(int(count[0])), np.empty(int(count[0]))
        state = np.empty(self._shape, dtype=np.intc)
        self._get("fuge_get_force", pointer, force)
        self._get("fuge_get_gap", pointer, gap)
        self._get("fuge_get_motion", pointer, motion)
        self._get("fuge_get_resultant", pointer, resultant)
        self._get("fuge_get_states", pointer, state)
        self._get("fuge_get_info", pointer, ctypes.byref(report))
        results = force, gap, motion, resultant, state, info_of(report), message, self.operator.cells
        contact = Contact(*results, _solver=weakref.ref(self))
        self._found = weakref.ref(contact)
        return contact

    def _has_found(self, contact: Contact) -> bool:
        """Is this the last solution?"""
        return self._found is not None and self._found() is contact

    def _get_case(self, name: str, pointer: ctypes.c_void_p, *arguments: Any) -> None:
        end_call(function(name)(pointer, *arguments), lambda: self._read_message(pointer))

    def _get(self, name: str, pointer: ctypes.c_void_p, result: Any) -> None:
        end_call(function(name)(pointer, result), lambda: self._read_message(pointer))

    def _laws(self, **values: ArrayLike | None) -> list[NDArray[np.float64] | None]:
        """One value for each point where there are any."""
        return [None if value is None else self._points(name, value) for name, value in values.items()]

    def _law_shapes(self) -> dict[str, tuple[int, ...]]:
        """Shapes of the arrays with the laws of the points, for messages."""
        return dict.fromkeys(("compliance", "limit", "limit_upper"), self._shape)

    def _force_weights(self, force: ArrayLike | None, pressure: ArrayLike | None) -> NDArray[np.float64] | None:
        """Partial derivatives of an objective by the forces, from those by forces and by pressures."""
        weights = None if force is None else self._points("force", force)
        if pressure is None:
            return weights
        by_pressure = self._points("pressure", pressure) / known_cells(self.operator.cells).size
        return by_pressure if weights is None else weights + by_pressure

    def _shape_of(self, value: ArrayLike) -> tuple[int, ...]:
        """The shape of results for an array with a value for each point, or one for all."""
        return np.shape(value) or self.operator.grid or (self.n,)

    def _points(self, name: str, value: ArrayLike) -> NDArray[np.float64]:
        """One value for each point; a single number stands for all of them."""
        found = _arrays.array(name, value)
        if found.ndim == 0:
            return _arrays.spread(name, found, self.n)
        return self.operator._points(name, found).reshape(-1)


def _motions(name: str, value: ArrayLike, m: int) -> NDArray[np.float64]:
    """One value for each of m motions; a number for one."""
    return _arrays.vector(name, np.atleast_1d(_arrays.array(name, value)), m)


def solve(
    operator: Operator | ArrayLike,
    gap: ArrayLike,
    load: float | None = None,
    *,
    approach: float | None = None,
    modes: ArrayLike | None = None,
    resultant: ArrayLike | None = None,
    motion: Mapping[int, float] | None = None,
    gap_upper: ArrayLike | None = None,
    excluded: ArrayLike | None = None,
    compliance: ArrayLike | None = None,
    limit: ArrayLike | None = None,
    limit_upper: ArrayLike | None = None,
    motion_stiffness: ArrayLike | None = None,
    method: Method | None = None,
    pivot_rule: PivotRule | None = None,
    max_iterations: int | None = None,
    tolerance: float | None = None,
    threads: int = ALL_CORES,
    progress: Progress | None = None,
    prove: bool = False,
) -> Contact:
    """Solve one contact problem; :class:`Solver` is for several ones, and for derivatives.

    Parameters
    ----------
    operator : Operator or array_like, shape (n, n)
        How the bodies deform: an influence matrix (displacement per force, symmetric), or an operator.
    gap : array_like, shape (n,) or that of the operator's grid, or float
        Initial gaps; length.
    load : float, optional
        Sum of the contact forces, not negative.
    approach : float, optional
        In place of the load: by how much the bodies approach each other; length.
    modes : array_like, shape (n, m), optional
        In place of both: several rigid motions; see :meth:`Solver.set_modes`.
    resultant : array_like, shape (m,), optional
        Resultants of the modes, in the order of their columns; those of prescribed motions do not count, and may be
        left out if all are prescribed.
    motion : dict, optional
        Prescribed motions, ``{mode: value}``.
    gap_upper : array_like of the shape of gap, or float, optional
        Play between two stops: infinity for one-sided contact, 0 for tied points; length.
    excluded : array_like of bool, shape of gap, optional
        Points that carry no force.
    compliance : array_like of the shape of gap, or float, optional
        Springs at the points; length per force; see
        :meth:`Solver.set_compliance`.
    limit, limit_upper : array_like of the shape of gap, or float, optional
        Limits of the forces; see :meth:`Solver.set_limits`.
    motion_stiffness : float, or array_like of shape (m,), optional
        Stiffnesses of springs on the motions, 0 for none; see :meth:`Solver.set_motion_stiffness`.
    method, pivot_rule, max_iterations, tolerance, threads, progress
        As in :class:`Solver`.
    prove : bool, optional
        Bound the errors of all forces, gaps and motions too: `proof` of the result, by :meth:`Solver.prove`.

    Returns
    -------
    Contact
        Forces, gaps, motions, and a report with the certificate.

    Raises
    ------
    Error
        Those of :meth:`Solver.solve`; also :class:`InputError` unless one of load, approach and modes is given.

    Examples
    --------
    >>> contact = fuge.solve([[0.2, 0.1], [0.1, 0.2]], gap=[0.0, 1.0], load=2.0)
    >>> contact.force, contact.gap, contact.approach
    (array([2., 0.]), array([0. , 0.8]), 0.4)
    """
    if sum(value is not None for value in (load, approach, modes)) != 1:
        raise error(Status.ERR_OPTION, "give one of load, approach and modes")
    if modes is None and (resultant is not None or motion is not None):
        raise error(Status.ERR_OPTION, "resultant and motion belong to modes, which are not given")
    with Solver(
        operator,
        method=method,
        pivot_rule=pivot_rule,
        max_iterations=max_iterations,
        tolerance=tolerance,
        threads=threads,
        progress=progress,
    ) as solver:
        solver.set_gap(gap, gap_upper)
        if excluded is not None:
            solver.set_excluded(excluded)
        if compliance is not None:
            solver.set_compliance(compliance)
        if limit is not None or limit_upper is not None:
            solver.set_limits(limit, limit_upper)
        if load is not None:
            solver.set_load(load)
        elif approach is not None:
            solver.set_approach(approach)
        elif modes is not None:
            solver.set_modes(modes, _resultants(modes, resultant, motion))
            for mode, value in (motion or {}).items():
                solver.set_motion(mode, value)
        if motion_stiffness is not None:
            for mode, stiffness in enumerate(_motions("motion_stiffness", motion_stiffness, solver.mode_count)):
                solver.set_motion_stiffness(mode, stiffness)
        contact: Contact = solver.solve()
        return replace(contact, proof=solver.prove()) if prove else contact


def _resultants(modes: ArrayLike, resultant: ArrayLike | None, motion: Mapping[int, float] | None) -> ArrayLike:
    """The resultants of modes, which may be left out if all motions are prescribed."""
    if resultant is not None:
        return resultant
    m = np.shape(modes)[-1] if np.ndim(modes) else 0
    free = [mode for mode in range(m) if mode not in (motion or {})]
    if free:
        raise error(
            Status.ERR_OPTION,
            f"modes need resultant, the sum of the forces times the column for each of the {m} modes, 0 where no load "
            f"acts: mode {free[0]} has neither a resultant nor a prescribed motion",
        )
    return np.zeros(m)
