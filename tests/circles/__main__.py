#!/usr/bin/env python3
"""Fails when files or folders of core/, or of a kind of plugins, use each other in a circle, and prints each circle with
what makes it; and when a folder holds more files than one looks through.

  python3 tests/circles BUILD

One file uses another when it needs a function or a variable that the other defines, as `nm` reads it from the objects of
the build; a function that libc has, too, is libc's, also where the program defines it for plugins. A folder uses another
when one of its files does, or includes one of its headers. The folders of the engine, the film and the motion use each
other in one direction alone: that is asked for by name, too. A name that several files of a kind define, each for its own shared
object, is a hook: who needs it depends on none of them.
"""

import collections
import ctypes
import json
import re
import subprocess
import sys
from pathlib import Path

MOST = 25  # .c files, or headers, of a folder

# each part with its folders, which may use those named before them; other kinds of plugins have none, or no order
PARTS = {
    'core': ['engine/value', 'engine/plugin', 'engine/pipeline', 'engine', 'program'],
    'core/program/study': ['store', 'cases', 'run', 'kinds/answer', 'kinds/uncertainty/estimates', 'kinds/uncertainty', 'kinds/tradeoff', 'kinds/stability', 'kinds'],
    'plugins/dynamics': ['excitation', 'oil', 'oscillator', 'orbits', 'continuation', 'series', 'coupled', 'stage'],
    'plugins/ehl': ['contact', 'equations', 'solvers', 'estimates', 'heat', 'time', 'errors', 'stage'],
}


def find_objects(build, part):
    """{file of the part: its object}"""
    about = json.loads((build / 'meson-info/meson-info.json').read_text())
    root = Path(about['directories']['source']).resolve()
    objects = {}
    for entry in json.loads((build / 'compile_commands.json').read_text()):
        file = (Path(entry['directory']) / entry['file']).resolve()
        if file.is_relative_to(root / part):
            objects[file.relative_to(root)] = Path(entry['directory']) / entry['output']
    return root, objects


def read_symbols(objects):
    """{name: the file that defines it}, {file: names that it needs}"""
    files = {str(path): file for file, path in objects.items()}
    libc = ctypes.CDLL('libc.so.6')
    defined, needed = collections.defaultdict(set), collections.defaultdict(set)
    output = subprocess.run(['nm', '-A', '-g', '-P', *files], check=True, capture_output=True, text=True).stdout
    for line in output.splitlines():
        path, name, kind, *_ = line.split()
        file = files[path.rstrip(':')]
        if kind == 'U':
            needed[file].add(name)
        elif not hasattr(libc, name):
            defined[name].add(file)
    return {name: file for name, (file, *others) in defined.items() if not others}, needed


def uses_of_files(objects):
    """{file: {used file: {names}}}"""
    defined, needed = read_symbols(objects)
    uses = {file: collections.defaultdict(set) for file in objects}
    for file, names in needed.items():
        for name in names & defined.keys():
            uses[file][defined[name]].add(name)
    return uses


def uses_of_folders(root, part, files):
    """The same between folders, includes of headers counted."""
    uses = collections.defaultdict(lambda: collections.defaultdict(set))
    for file, used in files.items():
        for other, names in used.items():
            if file.parent != other.parent:
                uses[file.parent][other.parent] |= {f'{name} in {file.name}' for name in names}
    for file in sorted((root / part).rglob('*.[ch]')):
        for name in re.findall(r'^#include "(.*)"', file.read_text(), re.MULTILINE):
            other = (file.parent / name).resolve()
            if other.is_relative_to(root / part) and other.parent != file.parent:
                folder = file.parent.relative_to(root)
                uses[folder][other.parent.relative_to(root)].add(f'{other.name} in {file.name}')
    return uses


def find_circles(uses):
    """The strongly connected components of more than one member, by Tarjan's algorithm."""
    number, low, stack, circles = {}, {}, [], []

    def visit(node):
        number[node] = low[node] = len(number)
        stack.append(node)
        for other in sorted(uses.get(node, {})):
            if other not in number:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], number[other])
        if low[node] == number[node]:
            at = stack.index(node)
            if len(stack) - at > 1:
                circles.append(stack[at:])
            del stack[at:]

    for node in sorted(uses):
        if node not in number:
            visit(node)
    return circles


def print_use(user, used, names, most=6):
    shown = ', '.join(sorted(names)[:most]) + (', ...' if len(names) > most else '')
    print(f'  {user} -> {used}: {shown}')


def print_circles(what, uses):
    circles = find_circles(uses)
    for circle in circles:
        print(f'a circle of {len(circle)} {what}:')
        for user in sorted(circle):
            for used in sorted(set(uses[user]) & set(circle)):
                print_use(user, used, uses[user][used])
    return len(circles)


def print_wrong_directions(part, folders):
    """A lower layer must not use a higher one, even where that closes no circle."""
    if part not in PARTS:
        return 0

    def layer(folder):
        return next(i for i, name in enumerate(PARTS[part]) if folder.is_relative_to(f'{part}/{name}'))

    wrong = 0
    for user, used in folders.items():
        for other, names in used.items():
            if layer(user) < layer(other):
                print(f'{user} must not use {other}:')
                print_use(user, other, names)
                wrong += 1
    return wrong


def count_faults(build, part):
    root, objects = find_objects(build, part)
    files = uses_of_files(objects)
    folders = uses_of_folders(root, part, files)
    edges = sum(map(len, files.values()))
    if part in PARTS and edges < len(objects):
        sys.exit(f'{edges} uses between {len(objects)} objects of {part}: nm does not read these')
    faults = print_circles('files', files) + print_circles('folders', folders) + print_wrong_directions(part, folders)
    print(f'{len(objects)} files of {part}, {edges} uses, {faults} faults')
    return faults


def print_crowded(root):
    """Folders with too many files."""
    faults = 0
    for folder in sorted(d for tree in ('core', 'plugins') for d in (root / tree).rglob('*') if d.is_dir()):
        sources, headers = (len(list(folder.glob(pattern))) for pattern in ('*.c', '*.h'))
        if max(sources, headers) > MOST:
            print(f'{folder.relative_to(root)} holds {sources} .c files and {headers} headers: more than {MOST}, split it')
            faults += 1
    return faults


def main(build):
    root = find_objects(build, 'core')[0]
    kinds = {f'plugins/{d.name}' for d in (root / 'plugins').iterdir() if any(d.rglob('*.c'))} - {'plugins/templates'}
    faults = sum(count_faults(build, part) for part in [*PARTS, *sorted(kinds - PARTS.keys())])
    return faults + print_crowded(root) > 0


if __name__ == '__main__':
    sys.exit(main(Path(sys.argv[1])))
