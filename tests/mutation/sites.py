"""Finds the places of a C++ file that can be changed, and writes the file with all of its mutants.

A mutant is a changed expression or a removed statement. It is compiled next to the original and chosen at run time by the
environment variable RUGOSA_MUTANT ("mutant schemata", Untch, Offutt & Harrold 1993), so that one build serves all mutants.
"""

import random
import re

# Each pattern stands for one kind of mistake; clang-format puts blanks round binary operators and none in templates.
OPERATORS = [
    (re.compile(r" < "), [" <= ", " > "]),
    (re.compile(r" > "), [" >= ", " < "]),
    (re.compile(r" <= "), [" < ", " >= "]),
    (re.compile(r" >= "), [" > ", " <= "]),
    (re.compile(r" == "), [" != "]),
    (re.compile(r" != "), [" == "]),
    (re.compile(r" && "), [" || "]),
    (re.compile(r" \|\| "), [" && "]),
    (re.compile(r" \+ "), [" - "]),
    (re.compile(r" - "), [" + "]),
    (re.compile(r" \* "), [" / "]),
    (re.compile(r" / "), [" * "]),
    (re.compile(r"\bstd::min\b"), ["std::max"]),
    (re.compile(r"\bstd::max\b"), ["std::min"]),
    (re.compile(r"\bstd::sin\b"), ["std::cos"]),
    (re.compile(r"\bstd::cos\b"), ["std::sin"]),
    (re.compile(r"\bminCoeff\b"), ["maxCoeff"]),
    (re.compile(r"\bmaxCoeff\b"), ["minCoeff"]),
    (re.compile(r"\btrue\b"), ["false"]),
    (re.compile(r"\bfalse\b"), ["true"]),
    (re.compile(r"!(?=[\w(])"), ["!!"]),  # of the same type as before
    (re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?:e-?\d+)?(?![\w.])"), ["number"]),
    (re.compile(r"(?<=\()-(?=[\w(])|(?<=[=,(?:] )-(?=[\w(])|^-(?=[\w(])"), [""]),
]


def masked(text):
    """The text with comments, literals and preprocessor lines blanked out, of the same length."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#[^\n]*', re.S | re.M)
    return pattern.sub(lambda m: re.sub(r"[^\n]", "\x01", m[0]), text)


def closing(text, start):
    """Position of the bracket that closes the one at `start`, or -1."""
    depth = 0
    for i in range(start, len(text)):
        if text[i] in "([{":
            depth += 1
        elif text[i] in ")]}":
            depth -= 1
            if depth == 0:
                return i
    return -1


def expressions(text):
    """Spans (start, end) of conditions, returned values and assigned values; in `text`, masked."""
    for match in re.finditer(r"\b(?:if|while) \(", text):
        end = closing(text, match.end() - 1)
        span = text[match.end():end]
        if end > 0 and ";" not in span and not re.search(r"[\w>&*] \w+ = ", span):
            yield match.end(), end
    for match in re.finditer(r"\breturn ([^;{}\[\]]+);", text):
        yield match.span(1)
    for match in re.finditer(r"^[ \t]+[\w:<>&*.,()\[\] \->]+? (?:=|\+=|-=|\*=|/=) ([^;{}]+);", text, re.M):
        if not re.search(r"\bconstexpr\b|\bvirtual\b", match[0]):  # these would not compile
            yield match.span(1)


def changed(expression, mask, choose):
    """The expression with one operator or number changed, or None."""
    places = []
    for pattern, others in OPERATORS:
        for match in pattern.finditer(mask):
            for other in others:
                places.append((match.start(), match.end(), other))
    if not places:
        return None
    start, end, other = choose.choice(places)
    if other == "number":
        old = expression[start:end]
        other = {"0": "1", "1": "2", "2": "3"}.get(old, f"(2 * {old})")
    return expression[:start] + other + expression[end:]


def described(text, start, expression):
    """The expression on one line, with the beginning of its line."""
    return " ".join((text[text.rfind("\n", 0, start) + 1:start] + expression).split())


def sites(text, choose):
    """All mutants of a file: (start, end, replacement with {id}, description)."""
    mask = masked(text)
    found, taken = [], []

    def free(start, end):
        return all(end <= a or start >= b for a, b in taken)

    spans = sorted(set(expressions(mask)), key=lambda span: (span[1] - span[0], span))
    choose.shuffle(spans)
    for start, end in spans:
        expression = text[start:end]
        if "\x01" in mask[start:end] and '"' in expression or not free(start, end) or "co_" in expression or "//" in expression:
            continue
        if re.search(r", (?:[\w*.>\[\]-]+ = |\+\+|--)", expression):  # a further declaration or assignment
            continue
        other = changed(expression, mask[start:end], choose)
        if other is None:
            continue
        taken.append((start, end))
        other = other.replace("\n", " ")  # lines keep their numbers
        found.append((start, end, "(rugosa_mutant({id}) ? (" + other + ") : (" + expression + "))",
                      described(text, start, expression) + " -> " + " ".join(other.split())))
    for match in re.finditer(r"^([ \t]+)((?!return\b|decltype\b|throw\b|delete\b|using\b|const\b|auto\b|else\b|if\b)[\w:.\->\[\]]+\([^;{}]*\));$", mask, re.M):
        start, end = match.span(2)
        before = mask[:match.start()].rstrip()
        if free(start, end + 1) and before and before[-1] in ";{}" and "refuse" not in match[2] \
                and not re.search(r"\b(reserve|prefetch)\(", match[2]):  # these only change the time
            taken.append((start, end + 1))
            call = text[start:end]
            found.append((start, end + 1, "if (!rugosa_mutant({id})) " + call + ";", "left out: " + " ".join(call.split())))
    return found


def broken(text, chosen):
    """The file with the chosen mutants, a list of (id, site)."""
    for number, (start, end, replacement, _) in sorted(chosen, key=lambda item: -item[1][0]):
        # The line numbers are kept, so that compiler errors can be assigned to mutants.
        body = replacement.replace("{id}", str(number))
        text = text[:start] + body + text[end:]
    return text
