"""Decks of Nastran and its kin: one-way elements, and the loads and supports of subcases."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Callable

from fuge.deck import Deck
from fuge.formats.bulk import Card, read_cards, read_lines
from fuge.formats.bulk_case_control import Subcase, split_deck
from fuge.formats.bulk_links import LinkCards
from fuge.formats.bulk_loads import LoadCards
from fuge.formats.bulk_nodes import NodeCards
from fuge.formats.bulk_words import CONTACT_CARDS, HARMLESS_CARDS, UNREAD_LOADS, check_parameter
from fuge.formats.text import PathLike, Place, Reason, quoted, refusal


def read_bulk_deck(path: PathLike) -> Deck:
    """Read the one-way links and the load cases of a deck of Nastran; FileError as of :func:`read_deck`."""
    deck = Deck()
    subcases, bulk = split_deck(list(read_lines(path, deck.paths)))
    if not bulk:
        raise refusal(path, "there is no bulk data above ENDDATA or the end of the file")
    nodes = NodeCards()
    links, loads = LinkCards(nodes), LoadCards(nodes)
    _read(read_cards(bulk), {**nodes.readers, **links.readers, **loads.readers, **_readers(loads)})
    if subcases is None:
        subcases = [Subcase(Place(deck.paths[0], 1), sets=loads.only_sets())]
        # Supports alone are no case: a table may have the loads.
        selects = "LOAD" in subcases[0].sets
    else:
        selects = any(command in subcases[0].sets for command in ("LOAD", "SPC"))
    deck._links += links.links()
    deck._supports = loads.supports(subcases[0])
    cases = subcases[1:] or (subcases if selects else [])
    deck._cases += [loads.case(subcase) for subcase in cases]
    return deck


# The last field that each card may have: what stands behind it belongs to another one.
_LAST_FIELD = dict(CBUSH1D=5, CGAP=8, CORD2R=11, FORCE=7, GRDSET=8, GRID=8, MOMENT=7, PARAM=3, PGAP=11, SPC=7, SPCD=7)

_Readers = dict[str, Callable[[Card], None]]


def _read(cards: Iterable[Card], readers: _Readers) -> None:
    harmless = set(HARMLESS_CARDS)
    for card in cards:
        if card.name in harmless:
            continue
        try:
            for k in card.filled(_LAST_FIELD.get(card.name, len(card.fields)) + 1):
                raise Reason(f"there is no field {k}, but {quoted(card.word(k))} stands there")
            readers.get(card.name, _refuse)(card)
        except Reason as reason:
            raise card.refuse(reason) from None


def _readers(loads: LoadCards) -> _Readers:
    """Readers of cards that only may be refused."""
    return {
        "PARAM": lambda card: check_parameter(card.word(1), card.word(2)),
        "MATS1": _refuse_material,
        **dict.fromkeys(UNREAD_LOADS, loads.read_unread),
    }


def _refuse_material(card: Card) -> None:
    raise Reason("materials that depend on the strain are not read: give cables and struts as CBUSH1D with a table")


def _refuse(card: Card) -> None:
    if card.name.startswith(CONTACT_CARDS):
        raise Reason("contact and springs of this kind are not read: CGAP, and CBUSH1D with a table, are")
    raise Reason("the card could change the answer, and is not read: take it out if it does not")
