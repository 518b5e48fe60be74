"""Draws small wrong changes of C: one sign, index, constant, term or pair of arguments.

The layout is that of clang-format: a binary operator has blanks around it, a unary one clings to its operand.
"""

import random
import re

OPERATORS = ('sign', 'index', 'constant', 'drop', 'swap')
EXTRA = ('boundary',)

TOKEN = re.compile(
    r'''(?P<skip>\s+|//[^\n]*|/\*.*?\*/)
      | (?P<hash>(?<![^\n])[ \t]*\#(?:\\\n|[^\n])*)
      | (?P<text>"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')
      | (?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?[\w.]*)
      | (?P<word>[A-Za-z_]\w*)
      | (?P<sign><<=|>>=|\.\.\.|->|\+\+|--|<<|>>|[-+*/%&|^<>=!]=|&&|\|\||.)''',
    re.VERBOSE | re.DOTALL,
)
PAIRS = {'(': ')', '[': ']', '{': '}'}
KEYWORDS = {'if', 'while', 'for', 'switch', 'return', 'sizeof', 'case', 'else', 'do', 'goto'}
TYPES = {'void', 'char', 'short', 'int', 'long', 'float', 'double', 'unsigned', 'signed', 'bool', 'const', 'struct'}
# what ends an operand of + and -
LOOSE = set('+ - = < > , ; ? : & | ^'.split()) | {
    '<=', '>=', '==', '!=', '&&', '||', '<<', '>>', '+=', '-=', '*=', '/=', '%=', '|=', '&=', '^=', 'return', 'case',
}
LOGIC = {',', ';', '?', ':', '&&', '||', '='}
# too little memory is what the sanitizers look for
ALLOCATES = {'malloc', 'calloc', 'realloc'}
# whose arguments may stand in any order
SYMMETRIC = {'fmax', 'fmin', 'hypot', 'fabs', 'fma'}


class Source:
    """The tokens of one file, their brackets, and which of them may be changed."""

    def __init__(self, text):
        self.text = text
        self.tokens = [
            (m.lastgroup, m.group(), m.start(), m.end())
            for m in TOKEN.finditer(text)
            if m.lastgroup not in ('skip', 'hash')
        ]
        self.partner = {}
        self.depth = []
        self._match()
        self.kept = self._kept()

    def _match(self):
        stack = []
        for i, (kind, text, _, _) in enumerate(self.tokens):
            self.depth.append(tuple(stack))
            if kind == 'sign' and text in PAIRS:
                stack.append(i)
            elif kind == 'sign' and text in PAIRS.values() and stack:
                self.partner[i] = stack[-1]
                self.partner[stack.pop()] = i
                self.depth[i] = tuple(stack)

    def word(self, i):
        return self.tokens[i][1] if 0 <= i < len(self.tokens) else ''

    def kind(self, i):
        return self.tokens[i][0] if 0 <= i < len(self.tokens) else ''

    def binary(self, i):
        """Whether blanks stand on both sides, as clang-format sets them around a binary operator."""
        _, _, start, end = self.tokens[i]
        return self.text[start - 1 : start].isspace() and self.text[end : end + 1].isspace()

    def _kept(self):
        """Tokens in bodies of functions and in numeric tables; not in brackets that hold a text."""
        texts = {self.depth[i][-1] for i in range(len(self.tokens)) if self.kind(i) == 'text' and self.depth[i]}
        kept = [False] * len(self.tokens)
        body = False
        for i in range(len(self.tokens)):
            outer = self.depth[i]
            if not outer:
                body = self.word(i) == '{' and self.word(i - 1) == ')'
            elif len(outer) == 1 and self.word(outer[0]) == '{':
                body = self.word(outer[0] - 1) == ')'
            inside = body or self.kind(i) == 'number' and self._initial(i)
            kept[i] = inside and not any(self._left_out(o, texts) for o in outer)
        return kept

    def _left_out(self, opening, texts):
        """Lists of arguments and tables that hold a text, not bodies of functions and loops; sizes of memory."""
        if self.word(opening) == '(' and self.word(opening - 1) in ALLOCATES:
            return True
        return opening in texts and (self.word(opening) != '{' or self.word(opening - 1) in ('=', ',', '{', '('))

    def _initial(self, i):
        """Whether a number outside of functions is one of an initialiser."""
        outer = self.depth[i]
        if outer:
            return self.word(outer[0]) == '{' and self.word(outer[0] - 1) == '='
        j = i
        while j > 0 and self.word(j - 1) not in (';', '}'):
            j -= 1
            if self.word(j) == '=':
                return True
        return False

    def cast(self, i):
        """Whether the bracket that opens at i is a cast."""
        if self.word(i) != '(' or i not in self.partner:
            return False
        inner = [self.word(k) for k in range(i + 1, self.partner[i])]
        return bool(inner) and all(
            w in TYPES or w == '*' or w.endswith('_t') or (w.startswith('ff_') and inner[-1] == '*') for w in inner
        )

    def right(self, i):
        """One past the factor that begins at i; None if it is none."""
        while self.word(i) in ('-', '+', '!', '~', '*', '&') or self.cast(i):
            i = self.partner[i] + 1 if self.word(i) == '(' else i + 1
        if self.word(i) == '(':
            i = self.partner.get(i, i) + 1
        elif self.kind(i) in ('word', 'number') and self.word(i) not in KEYWORDS:
            i += 1
        else:
            return None
        while True:
            if self.word(i) in ('(', '[') and i in self.partner:
                i = self.partner[i] + 1
            elif self.word(i) in ('.', '->'):
                i += 2
            else:
                return i

    def left(self, i):
        """The first token of the factor that ends at i; None if it is none."""
        while True:
            if self.word(i) in (')', ']') and i in self.partner:
                i = self.partner[i]
                before = i - 1
                called = self.kind(before) == 'word' and self.word(before) not in KEYWORDS
                if called or self.word(before) in (')', ']'):
                    i = before
                    continue
            elif self.kind(i) not in ('word', 'number'):
                return None
            if self.word(i - 1) in ('.', '->'):
                i -= 2
                continue
            break
        while True:
            before = i - 1
            if self.word(before) == ')' and self.cast(self.partner.get(before, before)):
                i = self.partner[before]
            elif self.word(before) in ('-', '!', '*', '&') and not self.binary(before):
                i = before
            else:
                return i

    def after(self, i, ends):
        """One past the operand that begins at i: it goes on to a token of ends or to a closing bracket."""
        while i < len(self.tokens):
            w = self.word(i)
            if w in PAIRS and i in self.partner:
                i = self.partner[i] + 1
                continue
            if w in PAIRS.values() or w in ends and (w not in '+-*&' or self.binary(i)):
                return i
            i += 1
        return i

    def before(self, i, ends):
        """The first token of the operand that ends at i."""
        while i >= 0:
            w = self.word(i)
            if w in PAIRS.values() and i in self.partner:
                if w == '}':
                    return i + 1
                i = self.partner[i] - 1
                continue
            if w in PAIRS or w in ends and (w not in '+-*&' or self.binary(i)):
                return i + 1
            i -= 1
        return 0

    def span(self, first, end):
        """Text from token `first` up to, without, token `end`."""
        return self.text[self.tokens[first][2] : self.tokens[end - 1][3]]

    def edit(self, first, end, new):
        return self.tokens[first][2], self.tokens[end - 1][3], new


def signs(s, i):
    w = s.word(i)
    if w in ('+', '-') and s.binary(i):
        yield s.edit(i, i + 1, '-' if w == '+' else '+')
    elif w in ('+=', '-='):
        yield s.edit(i, i + 1, '-=' if w == '+=' else '+=')
    elif w == '-':
        yield s.edit(i, i + 1, '')
    elif w in ('*', '/') and s.binary(i) and s.word(i + 1) != '-' and s.right(i + 1):
        yield s.edit(i + 1, i + 2, '-' + s.word(i + 1))


def declares(s, i):
    """Whether the bracket that opens at i gives the length of an array which is declared."""
    j = i
    while j > 0 and s.word(j - 1) not in (';', '{', '}', '=') and not (s.word(j - 1) == '(' and s.depth[i]):
        j -= 1
    if s.word(j - 1) == '=':
        return False
    first = s.word(j)
    return first in TYPES | {'static', 'unsigned'} or s.kind(j) == 'word' and (
        s.kind(j + 1) == 'word' and first not in KEYWORDS or s.word(j + 1) == '*' and not s.binary(j + 1)
    )


def indices(s, i):
    if s.word(i) != '[' or i not in s.partner or s.partner[i] == i + 1 or declares(s, i):
        return
    if s.kind(i - 1) != 'word' and s.word(i - 1) not in (')', ']'):
        return
    inner = s.span(i + 1, s.partner[i])
    if s.kind(i + 1) == 'text':
        return
    plain = s.partner[i] == i + 2
    body = inner if plain or not re.search(r'[?&|<>=]', inner.replace('->', '')) else f'({inner})'
    for step in ('+ 1', '- 1') if inner != '0' else ('+ 1',):
        yield s.edit(i + 1, s.partner[i], f'{body} {step}')


def constants(s, i):
    if s.kind(i) != 'number':
        return
    w = s.word(i)
    alone = s.word(i - 1) in '[{' and s.word(i + 1) in ']}'
    if alone or w[:2].lower() == '0x' or s.word(i - 1) == '[' and declares(s, i - 1):
        return
    body = w.rstrip('fFlLuU')
    tail = w[len(body) :]
    if re.fullmatch(r'\d+', body):
        n = int(body)
        step = max(1, round(n / 100))
        for m in (n + step, n - step) if n else (1,):
            yield s.edit(i, i + 1, f'{m}{tail}')
    else:
        for factor in (1.01, 0.99):
            x = float(f'{float(body) * factor:.12g}')
            yield s.edit(i, i + 1, (repr(x) if float(body) else '0.01') + tail)


def statement(s, i):
    """First and one past the last token of the statement that the assignment at i is; None if it is none."""
    first = s.before(i - 1, {';'})
    while s.word(first) == ')':
        first += 1
    end = s.after(i, {';'})
    if s.word(end) != ';' or s.word(first - 1) not in (';', '{', '}', ')'):
        return None
    inner = s.depth[i][-1] if s.depth[i] else -1
    return (first, end) if s.word(inner) == '{' else None


def drops(s, i):
    w = s.word(i)
    if w in ('+', '-') and s.binary(i):
        yield s.edit(i, s.after(i + 1, LOOSE), '')
        first = s.before(i - 1, LOOSE)
        if first < i and s.word(first - 1) not in ('+', '-') and s.word(first) not in KEYWORDS:
            yield s.edit(first, i + 1, '' if w == '+' else '-')
    elif w in ('*', '/') and s.binary(i) and s.right(i + 1):
        yield s.edit(i, s.right(i + 1), '')
    elif w in ('&&', '||'):
        yield s.edit(i, s.after(i + 1, LOGIC), '')
    elif w in ('+=', '-=', '*=', '/='):
        whole = statement(s, i)
        if whole:
            yield s.edit(*whole, '')


def swaps(s, i):
    w = s.word(i)
    if w == '-' and s.binary(i):
        first, end = s.before(i - 1, LOOSE), s.after(i + 1, LOOSE)
        if first < i and s.word(first - 1) != '-' and s.word(first) not in KEYWORDS:
            yield s.edit(first, end, f'{s.span(i + 1, end)} - {s.span(first, i)}')
    elif w == '/' and s.binary(i):
        first, end = s.left(i - 1), s.right(i + 1)
        if first is not None and end and s.word(first - 1) != '/':
            yield s.edit(first, end, f'{s.span(i + 1, end)} / {s.span(first, i)}')
    elif w == '(' and s.kind(i - 1) == 'word' and s.word(i - 1) not in KEYWORDS | SYMMETRIC and i in s.partner:
        yield from arguments(s, i)


def arguments(s, i):
    cuts = [i]
    k = i + 1
    while k < s.partner[i]:
        k = s.after(k, {','})
        cuts.append(k)
        k += 1
    for a, b, c in zip(cuts, cuts[1:], cuts[2:]):
        if any(s.kind(k) == 'text' for k in range(a, c)) or b == a + 1 or c == b + 1:
            continue
        one, two = s.span(a + 1, b), s.span(b + 1, c)
        if one != two:
            yield s.edit(a + 1, c, f'{two}, {one}')


def boundaries(s, i):
    other = {'<': '<=', '<=': '<', '>': '>=', '>=': '>'}.get(s.word(i))
    if other and s.binary(i):
        yield s.edit(i, i + 1, other)


MAKERS = {
    'sign': signs, 'index': indices, 'constant': constants, 'drop': drops, 'swap': swaps, 'boundary': boundaries,
}


def lines(text, start, end, new):
    """The number of the first line that an edit touches, its whole lines, and what stands there after it."""
    begin = text.rfind('\n', 0, start) + 1
    stop = text.find('\n', end)
    stop = len(text) if stop < 0 else stop
    return text.count('\n', 0, begin) + 1, text[begin:stop], text[begin:start] + new + text[end:stop]


def every(file, text, operators=OPERATORS):
    """All mutants of one file, by operator."""
    s = Source(text)
    found = {name: [] for name in operators}
    for name in operators:
        for i in range(len(s.tokens)):
            if not s.kept[i]:
                continue
            for start, end, new in MAKERS[name](s, i):
                line, old, changed = lines(text, start, end, new)
                if ''.join(old.split()) != ''.join(changed.split()):
                    found[name].append({'file': file, 'line': line, 'operator': name, 'old': old, 'new': changed})
    return found


def draw(files, seed, operators=OPERATORS):
    """Mutants of `files` (name: text) without end of repetition: each operator as often as any other."""
    pool = {name: [] for name in operators}
    for file in sorted(files):
        for name, found in every(file, files[file], operators).items():
            pool[name] += found
    dice = random.Random(str(seed))
    seen = set()
    while any(pool.values()):
        name = dice.choice([n for n in operators if pool[n]])
        mutant = pool[name].pop(dice.randrange(len(pool[name])))
        key = (mutant['file'], mutant['line'], mutant['new'])
        if key not in seen:
            seen.add(key)
            yield mutant
