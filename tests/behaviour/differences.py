"""Shows what differs between two recorded folders."""

import difflib
import re
from pathlib import Path

from take import Bad

SHOWN = 12  # lines of a difference


def records(folder):
    found = {str(p.relative_to(folder)): p for p in Path(folder).rglob('*') if p.is_file()}
    if not found:
        raise Bad(f'{folder}: nothing is recorded there')
    return found


def lines(path):
    """Lines that can be read: JSON is one long one."""
    text = path.read_bytes().decode(errors='backslashreplace')
    return re.sub(r'(.{60}[,{>])', r'\1\n', text).splitlines() if max(map(len, text.split('\n'))) > 400 else text.splitlines()


def show(name, a, b):
    print(f'differs: {name}')
    found = [d for d in difflib.unified_diff(lines(a), lines(b), lineterm='', n=0) if not d.startswith(('---', '+++', '@@'))]
    for line in found[:SHOWN]:
        print(f'  {line[:200]}')
    if len(found) > SHOWN:
        print(f'  and {len(found) - SHOWN} lines more')


def is_value(name):
    return name.startswith('numbers/')


def count(what, both, differ, alone):
    """Prints how many records of a group are the same. Whether there is a difference."""
    print(f'{what}: {len(both) - len(differ)} same, {len(differ)} differ, {len(alone)} only in one')
    return bool(differ or alone)


def diff(first, second):
    a, b = records(first), records(second)
    both = sorted(set(a) & set(b))
    differ = [name for name in both if a[name].read_bytes() != b[name].read_bytes()]
    for name in differ:
        show(name, a[name], b[name])
    alone = []
    for folder, here, other in ((first, a, b), (second, b, a)):
        for name in sorted(set(here) - set(other)):
            print(f'only in {folder}: {name}')
            alone.append(name)
    values = count('values', *([n for n in names if is_value(n)] for names in (both, differ, alone)))
    texts = count('texts', *([n for n in names if not is_value(n)] for names in (both, differ, alone)))
    return 1 if values else 2 if texts else 0
