"""libflankfilm gives what engine.h declares and nothing else, and the program takes nothing else from it. It defines no function
for others: libraries and plugins would have it in place of libc's.

exports.py HEADER LIBRARY PROGRAM SOURCE_ROOT
"""

import re
import subprocess
import sys
from pathlib import Path

NEEDED = {'libc.so.6', 'libm.so.6', 'libyaml-0.so.2'}


def declared(header):
    """Functions that the header declares."""
    text = re.sub(r'/\*.*?\*/', '', header.read_text(), flags=re.DOTALL)
    text = re.sub(r'^#.*', '', text, flags=re.MULTILINE)
    return set(re.findall(r'\b(ff_\w+)\(', text))


def symbols(file, which):
    """Names of the dynamic symbols, without their versions."""
    output = subprocess.run(['nm', '-D', '-P', which, file], check=True, capture_output=True, text=True).stdout
    return {line.split()[0].split('@')[0] for line in output.splitlines()}


def functions(file):
    """Those that the dynamic linker may give to others. Variables of libc are copied into a program that uses them."""
    output = subprocess.run(['nm', '-D', '-P', '--defined-only', file], check=True, capture_output=True, text=True).stdout
    return {line.split()[0] for line in output.splitlines() if line.split()[1] in 'TWi'}


def dynamic(file, tag):
    output = subprocess.run(['readelf', '-d', file], check=True, capture_output=True, text=True).stdout
    return set(re.findall(rf'\({tag}\).*\[(.*)\]', output))


def inside(source):
    """Lines of the program that include a header of the engine's own."""
    for file in sorted((source / 'core/program').rglob('*.[ch]')):
        for line in re.findall(r'^#include ".*\bengine/.*', file.read_text(), re.MULTILINE):
            yield f'{file.relative_to(source)}: {line}'


def main(header, library, program, source):
    names = declared(Path(header))
    given = {name for name in symbols(library, '--defined-only') if name.startswith('ff_')}
    other = symbols(library, '--defined-only') - given - {'FLANKFILM_0'}
    taken = symbols(program, '--undefined-only') & (given | other)
    faults = [
        ('declared, but not given', names - given),
        ('given, but not declared', given - names),
        ('given under a name of its own', other),
        ('taken by the program, but not declared', taken - names),
        ('a function that the program defines for all', functions(program)),
        ('needed by the library', dynamic(library, 'NEEDED') ^ NEEDED),
        ('not the name of the library', dynamic(library, 'SONAME') ^ {'libflankfilm.so.0'}),
        ('of the engine alone', set(inside(Path(source)))),
    ]
    for what, which in faults:
        for name in sorted(which):
            print(f'{name}: {what}')
    print(f'{len(names)} functions declared, {len(given)} given, {len(taken)} taken by the program')
    return not names or not taken or any(which for _, which in faults)


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
