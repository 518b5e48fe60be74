#!/usr/bin/env python3
"""Shows that a change of the program changed nothing that it does.

  python3 tests/behaviour compare REVISION [BUILD]
      builds REVISION in a folder of its own and holds BUILD (build) against it
  python3 tests/behaviour take BUILD OUT
      records what a build does: OUT/numbers, each output to the bit; OUT/bytes, what each command says and
      writes; OUT/pages, reports and figures
  python3 tests/behaviour diff A B
      the differences between two such folders, values (OUT/numbers) and texts counted apart;
      exit code 1 if a value differs, 2 if texts alone do
  --values
      records the values and no text: of each output of each stage its name, its shape and a hash of its doubles

Both builds get the examples of this tree. Bits depend on the CPU and its libraries: nothing recorded is kept.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from differences import diff  # noqa: E402
from take import Bad, Take  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]


def installed(build):
    """The program and its plugins, links to a shared object among them, without the tests."""
    out = subprocess.run(['meson', 'introspect', build, '--targets'], capture_output=True, text=True, check=True).stdout
    files = [(os.path.relpath(f, build), t['installed'] and t['type'] != 'custom') for t in json.loads(out) for f in t['filename']]
    return [f for f, taken in files if taken or (f.startswith('plugins/') and f.endswith('.so'))]


def built(revision, place):
    """A build of a revision; what stands there already is used again."""
    tree, build = place / 'tree', place / 'build'
    found = subprocess.run(['git', '-C', ROOT, 'rev-parse', '--verify', f'{revision}^{{commit}}'], capture_output=True, text=True)
    commit = found.stdout.strip()
    if not commit:
        raise Bad(f'{revision}: {ROOT} has no such revision')
    commands = [] if tree.exists() else [['git', 'clone', '-q', '--no-checkout', ROOT, tree]]
    commands += [['git', '-C', tree, 'fetch', '-q', ROOT, commit], ['git', '-C', tree, 'checkout', '-q', commit]]
    if not (build / 'build.ninja').exists():
        commands.append(['meson', 'setup', build, tree])
    for command in commands:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
        if done.returncode:
            raise Bad(f'{command[0]} failed:\n{done.stdout}{done.stderr}')
    subprocess.run(['ninja', '-C', build, 'build.ninja'], capture_output=True)
    done = subprocess.run(['ninja', '-C', build, *installed(build)], capture_output=True, text=True)
    if done.returncode:
        raise Bad(f'{revision} does not build:\n{done.stdout[-3000:]}')
    return build


def main(argv):
    p = argparse.ArgumentParser(prog='tests/behaviour', description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('what', choices=('compare', 'take', 'diff'))
    p.add_argument('first', metavar='REVISION|BUILD|A')
    p.add_argument('second', nargs='?', metavar='BUILD|OUT|B')
    p.add_argument('--values', action='store_true', help='values alone, no texts')
    p.add_argument('--scratch', default=Path(tempfile.gettempdir()) / 'flankfilm-behaviour', help='folder of `compare`, kept')
    a = p.parse_args(argv)
    if a.what != 'compare' and not a.second:
        p.error(f'{a.what} wants two folders')
    if a.what == 'diff':
        return diff(a.first, a.second)
    if a.what == 'take':
        Take(a.first, a.second, ROOT).all(texts=not a.values)
        return 0
    scratch = Path(a.scratch).resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    Take(built(a.first, scratch), scratch / 'before', ROOT).all(texts=not a.values)
    Take(a.second or ROOT / 'build', scratch / 'after', ROOT).all(texts=not a.values)
    return diff(scratch / 'before', scratch / 'after')


if __name__ == '__main__':
    try:
        sys.exit(main(sys.argv[1:]))
    except Bad as why:
        sys.exit(f'tests/behaviour: {why}')
