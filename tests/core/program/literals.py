# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists the numbers other than 0, 1, 2 and 1/2 in C files, and counts them: literals.py FILE..."""
import re
import sys

NUMBER = re.compile(r'(?<![\w.])(\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+)(?![\w.])')


def plain(text):
    """Without comments, texts and directives; its lines keep their numbers."""
    text = re.sub(r'/\*.*?\*/', lambda m: re.sub(r'[^\n]', ' ', m.group()), text, flags=re.S)
    return re.sub(r'"(\\.|[^"\\])*"', '""', re.sub(r'^#.*$', '', text, flags=re.M))


def main():
    count = 0
    for path in sys.argv[1:]:
        with open(path, encoding='utf-8') as file:
            lines = plain(file.read()).split('\n')
        for place, line in enumerate(lines, 1):
            for found in NUMBER.findall(line):
                if float(found) not in (0, 1, 2, 0.5):
                    print(f'{path}:{place}: {found}')
                    count += 1
    print(count)


main()
