#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds what can be held of sentences: file heads, lengths, links, equations, and no private names in the guide.

pages.py SOURCE_ROOT"""
import pathlib
import re
import sys

LONGEST_CHAPTER = 300  # lines of a chapter of the guide
LONGEST_CHANGE = 160  # characters of a line of changes.md
MOST_WORDS = 60000  # of all pages but those of validation
EQUATION = r'\(((?:1[0-5]|[2-9])\.[0-9]{1,2}[a-z]?)\)'
# a commit, or the seed of a drawn scene: a reader of the guide has neither
PRIVATE = re.compile(r'\b(?=[0-9a-f]*[a-f])(?=[0-9a-f]*[0-9])[0-9a-f]{7,40}\b|\bseeds? [0-9]{5,}')


def begins_with_head(path):
    text = re.sub(r'\A(/\* SPDX[^\n]*\n|\s)*', '', path.read_text(encoding='utf-8'))
    return text.startswith(('/*', '//'))


def check_heads(root):
    """A source file begins with a comment on what it is; that of NAME.c may stand in NAME.h."""
    for folder in 'core', 'plugins', 'include':
        for path in sorted((root / folder).rglob('*.[ch]')):
            header = path.with_suffix('.h')
            if not begins_with_head(path) and not (path.suffix == '.c' and header.exists() and begins_with_head(header)):
                yield f'{path.relative_to(root)}:1: no comment says what the file is'


def check_lengths(root):
    for path in sorted((root / 'docs/guide').glob('*.md')):
        lines = path.read_text(encoding='utf-8').count('\n')
        if lines > LONGEST_CHAPTER:
            yield f'{path.relative_to(root)}: {lines} lines, {LONGEST_CHAPTER} at most'
    for number, line in enumerate((root / 'docs/changes.md').read_text(encoding='utf-8').splitlines(), 1):
        if len(line) > LONGEST_CHANGE:
            yield f'docs/changes.md:{number}: {len(line)} characters, {LONGEST_CHANGE} at most'
    words = sum(len(path.read_text(encoding='utf-8').split())
                for path in [root / 'README.md', *(root / 'docs').glob('*.md'), *(root / 'docs/guide').glob('*.md')])
    if words > MOST_WORDS:
        yield f'docs: {words} words, {MOST_WORDS} at most; say it in one place, shorter'


def anchors_of(text):
    """The names that links may give behind "#": headings as GitHub names them, and <a id>."""
    names, code = set(re.findall(r'<a id="([^"]*)"', text)), False
    for line in text.splitlines():
        code ^= line.startswith('```')
        if line.startswith('#') and not code:
            names.add(re.sub(r'[^\w\- ]', '', line.lstrip('#').strip().lower()).replace(' ', '-'))
    return names


def check_links(root):
    pages = [root / 'README.md', *sorted((root / 'docs').glob('*.md')), *sorted((root / 'docs/guide').glob('*.md')),
             *sorted((root / 'docs/validation').glob('*.md'))]
    for page in pages:
        for number, line in enumerate(page.read_text(encoding='utf-8').splitlines(), 1):
            for link in re.findall(r'\]\(([^)\s]+)\)', line):
                if link.startswith(('http:', 'https:')):
                    continue
                name, _, anchor = link.partition('#')
                target = page.parent / name if name else page
                if not target.exists():
                    yield f'{page.relative_to(root)}:{number}: {name} is not there'
                elif anchor and anchor not in anchors_of(target.read_text(encoding='utf-8')):
                    yield f'{page.relative_to(root)}:{number}: {link} has no such heading'


def check_names(root):
    for path in [root / 'README.md', root / 'docs/guide.md', *sorted((root / 'docs/guide').glob('*.md'))]:
        for number, line in enumerate(path.read_text(encoding='utf-8').splitlines(), 1):
            found = PRIVATE.search(line)
            if found:
                yield f'{path.relative_to(root)}:{number}: "{found[0]}" means nothing to a reader'


def check_equations(root):
    """Each equation that theory.md mentions is the last of its line, apart from its source: a re-wrap would join lines."""
    lines = (root / 'docs/theory.md').read_text(encoding='utf-8').splitlines()
    ends = [re.findall(rf'(?<=\S)  +{EQUATION}|(?<=\S) {EQUATION}(?=$|  )', line) for line in lines if line.startswith('    ')]
    known = {number for found in ends for pair in found for number in pair}
    for at, line in enumerate(lines, 1):
        for number in re.findall(EQUATION, line):
            if number not in known and not line.startswith('|'):
                yield f'docs/theory.md:{at}: ({number}) stands behind no formula'


def check_signs(root):
    """In a paragraph, a line that begins with the sign of a formula would be shown as an item of a list."""
    for path in [root / 'README.md', *sorted((root / 'docs').rglob('*.md'))]:
        prose, code, before = False, False, ''
        for at, line in enumerate(path.read_text(encoding='utf-8').splitlines(), 1):
            code ^= line.startswith('```')
            if not before:
                prose = re.match(r'[-+*] |[0-9]+\. |[ |#<]', line) is None and not code
            elif prose and re.match('[-+*] ', line):
                yield f'{path.relative_to(root)}:{at}: a paragraph is broken before a sign'
            before = line


def main():
    root = pathlib.Path(sys.argv[1])
    checks = check_heads, check_lengths, check_links, check_names, check_equations, check_signs
    faults = [fault for check in checks for fault in check(root)]
    print(*faults, sep='\n', end='\n' if faults else '')
    sys.exit(bool(faults))


if __name__ == '__main__':
    main()
