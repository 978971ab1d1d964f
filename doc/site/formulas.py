"""Formulas as text in one line, for the excerpts of the search: x^2 and a/b where they can be read, else dots."""

import re

SYMBOLS = {
    "le": "≤", "leq": "≤", "ge": "≥", "geq": "≥", "ne": "≠", "neq": "≠", "approx": "≈", "sim": "~", "ll": "≪",
    "gg": "≫", "cdot": "·", "times": "×", "pm": "±", "infty": "∞", "partial": "∂", "nabla": "∇", "int": "∫", "sum": "Σ",
    "prod": "Π", "to": "→", "rightarrow": "→", "in": "∈", "perp": "⊥", "ldots": "..", "dots": "..", "cdots": "..",
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "varepsilon": "ε", "zeta": "ζ", "eta": "η",
    "theta": "θ", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ",
    "tau": "τ", "phi": "φ", "varphi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω", "Gamma": "Γ", "Delta": "Δ",
    "Lambda": "Λ", "Pi": "Π", "Sigma": "Σ", "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω", "T": "T",
    "ast": "*", "lvert": "|", "rvert": "|", "thinspace": " ",
}
# Words that change the look only.
LOOKS = (r"\\(?:left|right|big|Big|bigl|bigr|Bigl|Bigr|displaystyle|limits|quad|qquad|boldsymbol|mathbf|mathrm|text|"
         r"operatorname|mathsf|bar|hat|tilde)(?![A-Za-z])")
GROUP = r"\{([^{}]*)\}"
LONGEST = 90
UNREADABLE = "..."


def spoken(tex):
    """The formula as text; dots in place of a long one, or of one in several lines."""
    text = re.sub(r"\s+", " ", tex).strip()
    if "\\begin" in text or "\\\\" in text:
        return UNREADABLE
    text = re.sub(r"\\[,;!:> ]|~", " ", text).replace(r"\{", "(").replace(r"\}", ")")
    text = re.sub(LOOKS, "", text)
    before = None
    while before != text:
        before = text
        text = re.sub(rf"\\[dt]?frac *{GROUP} *{GROUP}", lambda m: f"{_factor(m[1])}/{_factor(m[2])}", text)
        text = re.sub(rf"\\sqrt *{GROUP}", r"√(\1)", text)
        text = re.sub(rf"([_^]) *{GROUP}", lambda m: m[1] + _factor(m[2]), text)
        text = re.sub(rf"(?<![_^}}]) *(?<!\\frac)(?<!\\sqrt){GROUP}(?! *\{{)", r" \1", text)
    text = re.sub(r"\\([A-Za-z]+)( ?)", lambda m: SYMBOLS.get(m[1], m[1]) + m[2], text)
    text = re.sub(r" +", " ", text).strip()
    return UNREADABLE if len(text) > LONGEST or re.search(r"[\\{}&]", text) else text


def _factor(text):
    """Text that may stand beside a stroke, or above or below the line."""
    text = text.strip()
    return text if re.fullmatch(r"\\?[A-Za-z]+|[\d.]+|[^\s+\-*/]", text) else f"({text})"
