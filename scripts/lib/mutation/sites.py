"""The sites of operators and constants in C sources, and what a mutant makes of each.

A site is found by its tokens, outside comments, texts and preprocessor lines. What binary and what unary operators are is read off the
white space, which .clang-format keeps. The draw hangs on the seed and on each site's own line of text alone: a change elsewhere moves none."""
import hashlib
import re

TOKEN = re.compile(r"""
    (?P<number>(?:0[xX][0-9a-fA-F]+|(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?)[uUlLfF]*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<op><<=|>>=|\.\.\.|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[-+*/%<>=!&|^~?:;,.()\[\]{}])
""", re.X)
BLANK = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|^[ \t]*#(?:\\\n|[^\n])*', re.S | re.M)
LEVEL = {"*": 10, "/": 10, "%": 10, "+": 9, "-": 9, "<<": 8, ">>": 8, "<": 7, "<=": 7, ">": 7, ">=": 7, "==": 6, "!=": 6,
         "&": 5, "^": 4, "|": 3, "&&": 2, "||": 1}
ASSIGN = {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="}
DROP = "left alone"
BINARY = {"<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"), "==": ("!=",), "!=": ("==",),
          "+": ("-", DROP), "-": ("+", DROP), "*": ("/",), "/": ("*",), "%": ("/",), "&&": ("||",), "||": ("&&",),
          "&": ("|",), "|": ("&",), "<<": (">>",), ">>": ("<<",)}
ASSIGNED = {"+=": ("-=", DROP), "-=": ("+=", DROP), "*=": ("/=",), "/=": ("*=",)}
CALLS = {"fmin": "fmax", "fmax": "fmin", "most": "least", "least": "most"}
KEYWORDS = {"return", "case", "else", "do", "goto", "sizeof"}
CLOSING, OPENING = {")": "(", "]": "[", "}": "{"}, {"(", "[", "{"}


class Token:
    __slots__ = ("text", "kind", "start", "end")

    def __init__(self, match):
        self.text, self.kind, self.start, self.end = match.group(), match.lastgroup, match.start(), match.end()


class Site:
    """One mutant of one site: `left` and `right` are spans of the text; `form` says how they are put together."""

    def __init__(self, path, text, token, form, span, left, right, changed, rebuild):
        self.path, self.form, self.span, self.left, self.right = path, form, span, left, right
        self.token, self.changed, self.rebuild = token.text, changed, rebuild
        start = text.rfind("\n", 0, token.start) + 1
        end = text.find("\n", token.start)
        self.line = text.count("\n", 0, token.start) + 1
        self.source = text[start:end if end >= 0 else len(text)].strip()
        self.column = len(text[start:token.start].lstrip())
        self.repeat = 0
        self.number = 0

    def place(self):
        return f"{self.path}|{self.source}|{self.repeat}|{self.column}"

    def key(self):
        return f"{self.place()}|{self.token} -> {self.changed}"

    def rank(self, seed):
        return hashlib.sha256(f"{seed}|{self.place()}".encode()).hexdigest()


def tokens_of(text):
    blanked = BLANK.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)
    return [Token(m) for m in TOKEN.finditer(blanked)]


def partners(tokens):
    """For each bracket the index of the other; None for what has none (a bracket that preprocessor lines share)."""
    other, stack = {}, []
    for i, t in enumerate(tokens):
        if t.text in OPENING:
            stack.append(i)
        elif t.text in CLOSING:
            if not stack or tokens[stack[-1]].text != CLOSING[t.text]:
                return None
            other[i] = stack.pop()
            other[other[i]] = i
    return other


def spaced(text, token):
    return text[token.start - 1] in " \n" and text[token.end] in " \n"


def is_operand(token):
    return token.kind == "number" or (token.kind == "name" and token.text not in KEYWORDS) or token.text in (")", "]", "}")


def is_binary(text, tokens, i):
    t = tokens[i]
    return t.text in LEVEL and i > 0 and is_operand(tokens[i - 1]) and spaced(text, t)


def left_start(text, tokens, other, i):
    """The first token of the left operand of the binary operator i."""
    level, k = LEVEL[tokens[i].text], i - 1
    while k >= 0:
        t = tokens[k]
        if t.text in (")", "]"):
            k = other[k] - 1
            continue
        if t.text in OPENING or t.text in (";", "}", ",", "?", ":") or t.text in ASSIGN or t.text in ("return", "case", "else"):
            break
        if is_binary(text, tokens, k) and LEVEL[t.text] < level:
            break
        k -= 1
    return k + 1


def right_end(text, tokens, other, i, level):
    """The last token of the operand that starts behind i."""
    k = i + 1
    while k < len(tokens):
        t = tokens[k]
        if t.text in ("(", "[") or (t.text == "{" and tokens[k - 1].text == ")"):
            k = other[k] + 1
            continue
        if t.text in CLOSING or t.text in ("{", ";", ",") or t.text in ASSIGN or (level >= 0 and t.text in ("?", ":")):
            break
        if k > i + 1 and is_binary(text, tokens, k) and LEVEL[t.text] <= level:
            break
        k += 1
    return k - 1


def unary_end(tokens, other, i):
    """The last token of the operand of the unary operator i."""
    k = i + 1
    while tokens[k].text in ("-", "!", "~", "*", "&", "+"):
        k += 1
    if tokens[k].text == "(":
        closed = other[k]
        after = tokens[closed + 1]
        k = closed
        if after.kind in ("name", "number") and tokens[closed].end == after.start:  # a cast
            k = closed + 1
    while k + 1 < len(tokens) and tokens[k + 1].text in ("(", "[", ".", "->"):
        k = other[k + 1] if tokens[k + 1].text in ("(", "[") else k + 2
    return k


def other_number(text, choice):
    body = text.rstrip("uUlLfF") if not text.lower().startswith("0x") else text.rstrip("uUlL")
    suffix = text[len(body):]
    if re.fullmatch(r"\d+|0[xX][0-9a-fA-F]+", body) and "f" not in suffix.lower():
        value = int(body, 0) if not re.fullmatch(r"0\d+", body) else int(body, 8)
        return f"{value + 1 if value == 0 or choice % 2 else value - 1}{suffix}"
    value = float(body)
    if value == 0.0:
        return "1.0" + suffix
    if abs(value) < 1e-3:
        return f"{value * 1e6:.17g}{suffix}"  # a tolerance or a floor: 3 % of it would be no fault
    changed = value * (1.03 if choice % 2 else 5.0 / 6.0)
    shown = f"{changed:.12g}"
    return (shown if "." in shown or "e" in shown else shown + ".0") + suffix


def is_size(tokens, other, i):
    """Is the number i the size of an array that is declared here?"""
    if i == 0 or tokens[i - 1].text != "[" or tokens[i + 1].text != "]":
        return False
    k = i - 2
    while tokens[k].text == "]":
        k = other[k] - 1
    if k < 1 or tokens[k].kind != "name":
        return False
    before = tokens[k - 1]
    if before.kind == "name" and before.text not in KEYWORDS:
        return True
    while k > 0 and tokens[k].text not in (";", "{", "}", "("):  # a list of declarations: `double a[3], b[3]`
        k -= 1
    return before.text in (",", "*") and tokens[k + 1].kind == "name" and (tokens[k + 2].kind == "name" or tokens[k + 2].text == "*")


class Regions:
    """Where functions are, and what of the rest are values: the C of a file without its parse."""

    def __init__(self, tokens, other):
        self.inside = [False] * len(tokens)      # in a function's body
        self.value = [False] * len(tokens)       # behind a `=`, in a declaration outside functions
        self.constant = [False] * len(tokens)    # must be known to the compiler: a static, a label
        self.condition = [False] * len(tokens)   # the second part of a `for`
        i, behind = 0, False
        while i < len(tokens):
            t = tokens[i].text
            if t == "enum":  # capacities, and names of choices
                opened = next((k for k in (i + 1, i + 2) if tokens[k].text == "{"), None)
                i = other[opened] if opened else i
                i += 1
                continue
            if t == "{" and not behind and i > 0 and tokens[i - 1].text == ")":
                for k in range(i, other[i] + 1):
                    self.inside[k] = True
                i = other[i]
            elif t == "=":
                behind = True
            elif t == ";":
                behind = False
            elif behind:
                self.value[i] = True
            i += 1
        self.mark(tokens, other)

    def mark(self, tokens, other):
        for i, t in enumerate(tokens):
            if self.inside[i] and t.text == "static":
                self.until(tokens, i, ";")
            elif t.text == "case":
                self.until(tokens, i, ":")
            elif t.text == "for" and tokens[i + 1].text == "(":
                parts, k, last = 0, i + 2, other[i + 1]
                while k < last:
                    if tokens[k].text == ";":
                        parts += 1
                    elif tokens[k].text in OPENING:
                        k = other[k]
                    if k < last and parts == 1:
                        self.condition[k] = True
                    k += 1

    def until(self, tokens, i, end):
        while tokens[i].text != end:
            self.constant[i] = True
            i += 1


def sites_of(path, text, seed):
    """Every site of a file with its mutant, in order."""
    tokens = tokens_of(text)
    other = partners(tokens)
    if other is None:
        return []
    regions = Regions(tokens, other)
    found = []
    for i, t in enumerate(tokens):
        if not (regions.inside[i] or regions.value[i]):
            continue
        rebuild = not regions.inside[i] or regions.constant[i]
        draft = site_at(path, text, tokens, other, i, regions, rebuild)
        if draft:
            found.append(draft)
    seen = {}
    sites = []
    for make in found:
        site = make(0)
        base = (site.source, site.column)
        site.repeat = seen.get(base, 0)
        seen[base] = site.repeat + 1
        chosen = make(int(site.rank(f"{seed} which")[:8], 16))
        chosen.repeat = site.repeat
        sites.append(chosen)
    return sites


def site_at(path, text, tokens, other, i, regions, rebuild):
    """A function of a number that makes one of the mutants of token i; None where there is no site."""
    t = tokens[i]

    def made(form, span, left, right, choices):
        return lambda n: Site(path, text, t, form, span, left, right, choices[n % len(choices)], rebuild)

    if t.kind == "number":
        alone = i > 0 and tokens[i - 1].text == "{" and tokens[i + 1].text == "}" and t.text == "0"
        if alone or is_size(tokens, other, i):
            return None
        return lambda n: Site(path, text, t, "number", (t.start, t.end), None, None, other_number(t.text, n), rebuild)
    if t.kind == "name":
        if t.text not in CALLS or tokens[i + 1].text != "(":
            return None
        last = tokens[other[i + 1]]
        return made("call", (t.start, last.end), None, (tokens[i + 1].start, last.end), (CALLS[t.text],))
    if t.text in ASSIGNED:
        first, last = tokens[i + 1], tokens[right_end(text, tokens, other, i, -1)]
        span = (first.start, last.end)
        return made("assign", span, None, span, ASSIGNED[t.text])
    if is_binary(text, tokens, i):
        first, last = tokens[left_start(text, tokens, other, i)], tokens[right_end(text, tokens, other, i, LEVEL[t.text])]
        left, right = (first.start, tokens[i - 1].end), (tokens[i + 1].start, last.end)
        if regions.condition[i] and t.text in ("<", "<="):
            return made("bound", right, left, right, ({"<": "<=", "<=": "<"}[t.text],))
        return made("binary", (left[0], right[1]), left, right, BINARY[t.text]) if t.text in BINARY else None
    if t.text in ("-", "!") and text[t.end] not in " \n" and not (i > 0 and is_operand(tokens[i - 1]) and tokens[i - 1].text != ")"):
        last = tokens[unary_end(tokens, other, i)]
        return made("unary", (t.start, last.end), None, (t.end, last.end), (DROP,))
    return None


def changed_text(site, render):
    """The mutant's own text; `render` gives what stands in a span."""
    if site.form == "number":
        return site.changed
    if site.form == "call":
        return site.changed + render(site.right)
    if site.form == "unary":
        return ("!!" if site.token == "!" else "") + f"({render(site.right)})"
    if site.form == "assign":
        if site.changed == DROP:
            return "0"
        return ("-" if site.changed in ("+=", "-=") else "1 / ") + f"({render(site.right)})"
    if site.form == "bound":
        return f"({render(site.right)}) {'+' if site.token == '<' else '-'} 1"
    if site.changed == DROP:
        return render(site.left)
    return f"({render(site.left)}) {site.changed} ({render(site.right)})"
