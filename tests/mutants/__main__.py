#!/usr/bin/env python3
"""Makes small bugs, one at a time, in a copy of the tree, and tells which of them no test sees.

  python3 tests/mutants plugins/dynamics --suite dynamics --draw 50 --seed 1
      50 mutants of the C files of a folder; each is built and the tests of the suite are run, the fastest first, up to
      the first that fails
  python3 tests/mutants --list tests/sabotage/NAME.txt --run 'sh judge.sh'
      bugs of a list, by a command whose exit code decides: 0, the bug lives; else it is killed. It gets
      MUTANT_BUILD (build directory), MUTANT_SOURCE (the copy of the tree) and MUTANT_NAME in its environment, and the
      last line that it prints stands in the results
  python3 tests/mutants --only-survivors RESULTS --suite dynamics
      what lived in an earlier campaign once more, now with the tests of today

A list of bugs consists of blocks, and the old text must be unique in its file:
  # name: what it breaks
  file: plugins/ehl/equations/reynolds.c
  - the old text, one or several lines
  + the new text, none, one or several lines

A mutant that does not compile, or that compiles to the same object, is drawn again. One that takes ten times the CPU
time of the healthy tree and --grace counts as killed. A campaign that was interrupted goes on where it stopped when it is given
the same arguments.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from draw import EXTRA, OPERATORS, draw  # noqa: E402
from records import Bad, Results, applied, given  # noqa: E402
from scratch import Scratch, shell  # noqa: E402

PATIENCE = 10  # times the CPU time on the healthy tree
WALL = 20  # s of the clock for one of CPU time, on a machine that others use, too


def arguments(argv):
    p = argparse.ArgumentParser(
        prog='tests/mutants', description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    p.add_argument('what', nargs='*', metavar='FILE', help='C files or folders to draw mutants of')
    p.add_argument('--draw', type=int, default=50, metavar='N', help='mutants that are judged (50)')
    p.add_argument('--seed', default='1', help='the same seed and files give the same mutants (1)')
    p.add_argument('--operators', default=','.join(OPERATORS), help='of ' + ','.join(OPERATORS + EXTRA))
    p.add_argument('--list', metavar='FILE', help='bugs of a list instead of drawn ones')
    p.add_argument('--only-survivors', metavar='RESULTS', help='what lived in an earlier campaign')
    p.add_argument('--suite', nargs='+', default=[], help='run the tests of these suites')
    p.add_argument('--test', nargs='+', default=[], help='run these tests')
    p.add_argument('--without', nargs='+', default=[], metavar='TEST', help='but not these tests')
    p.add_argument('--below', type=float, metavar='S', help='and none that takes more CPU seconds than this')
    p.add_argument('--run', metavar='COMMAND', help='run this command instead of tests')
    p.add_argument('--build', nargs='+', metavar='TARGET', help='what to build for the command (all)')
    p.add_argument('--grace', type=float, default=10, metavar='S', help='CPU seconds that any mutant may take (10)')
    p.add_argument('--source', default=Path(__file__).resolve().parents[2], help='the tree (this one)')
    p.add_argument('--scratch', help='folder of the copy and its build, kept for the next time')
    p.add_argument('--results', metavar='FILE', help='where the results go (SCRATCH/results.jsonl)')
    p.add_argument('--setup', nargs='+', default=[], metavar='OPTION', help='more options of meson setup')
    p.add_argument('--at-least', type=float, default=0, metavar='PERCENT', help='exit with 1 if fewer are killed')
    p.add_argument('--show', action='store_true', help='only print the mutants')
    a = p.parse_args(argv)
    if sum(map(bool, (a.what, a.list, a.only_survivors))) != 1:
        p.error('expected either files to draw mutants of, or --list, or --only-survivors')
    if not a.show and bool(a.run) == bool(a.suite or a.test):
        p.error('expected either --suite or --test, or --run')
    unknown = set(a.operators.split(',')) - set(OPERATORS + EXTRA)
    if unknown:
        p.error(f'--operators: {", ".join(sorted(unknown))}: expected some of {", ".join(OPERATORS + EXTRA)}')
    a.scratch = a.scratch or Path(tempfile.gettempdir()) / 'flankfilm-mutants'
    return a


def sources(source, what):
    """Texts of the C files that are named or lie below the folders that are named."""
    files = {}
    for name in what:
        path = (Path(source) / name).resolve()
        found = sorted(path.rglob('*.c')) if path.is_dir() else [path]
        if not found or not all(f.is_file() for f in found):
            raise Bad(f'{name}: expected a C file or a folder with C files in {source}')
        for f in found:
            files[str(f.relative_to(Path(source).resolve()))] = f.read_text()
    return files


def bugs(a):
    """The mutants of this campaign, and how many of them to judge."""
    if a.list:
        found = given(a.list)
    elif a.only_survivors:
        if not Path(a.only_survivors).is_file():
            raise Bad(f'{a.only_survivors}: there is no such file of results')
        found = [
            {k: m[k] for k in ('file', 'line', 'operator', 'old', 'new', 'name', 'what') if k in m and (k != 'line' or 'name' not in m)}
            for m in Results(a.only_survivors).rows.values() if m['outcome'] == 'lived'
        ]
    else:
        return draw(sources(a.source, a.what), a.seed, a.operators.split(',')), a.draw
    return found, len(found)


class Judge:
    """Runs what decides on a mutant; the healthy tree has told how long each part takes."""

    def __init__(self, a, scratch):
        self.scratch, self.grace = scratch, a.grace
        self.log = scratch.place / 'log.txt'
        if a.run:
            self.targets = a.build or ['all']
            self.parts = [{'name': 'command', 'cmd': shell(a.run), 'env': {}, 'workdir': None}]
        else:
            self.parts = chosen(scratch.tests, a)
            self.targets = scratch.needed(self.parts)
        good, said = scratch.ninja(*self.targets)
        if not good:
            raise Bad('the healthy tree does not build:\n' + said[-3000:])
        for part in self.parts:
            part['seconds'] = self.healthy(part)
        self.parts.sort(key=lambda t: t['seconds'])
        if a.below:
            self.parts = [t for t in self.parts if t['seconds'] <= a.below]
        if not self.parts:
            raise Bad('no test is left to run')

    def once(self, part, name, cpu):
        environment = {
            **part['env'], 'MUTANT_BUILD': str(self.scratch.build), 'MUTANT_SOURCE': str(self.scratch.tree),
            'MUTANT_NAME': name,
        }
        return self.scratch.run(part['cmd'], environment, part['workdir'], cpu, WALL * cpu, self.log)

    def healthy(self, part):
        code, seconds = self.once(part, 'healthy', 3600)
        if code:
            raise Bad(f'{part["name"]} fails on the healthy tree:\n' + self.log.read_text(errors='replace')[-3000:])
        return seconds

    def said(self):
        lines = self.log.read_text(errors='replace').split('\n')
        return next((line for line in reversed(lines) if line.strip()), '')

    def verdict(self, name):
        """killed, timeout or lived; by which part; the last line that it printed."""
        for part in self.parts:
            code, _ = self.once(part, name, self.grace + PATIENCE * part['seconds'])
            if code is None:
                return 'timeout', part['name'], ''
            if code:
                return 'killed', part['name'], self.said()
        return 'lived', '', self.said()


def chosen(tests, a):
    short = lambda suites: {s.split(':')[-1] for s in suites}  # noqa: E731
    known = {t['name'] for t in tests} | {s for t in tests for s in short(t['suite'])}
    for name in a.suite + a.test + a.without:
        if name not in known:
            raise Bad(f'{name}: expected a test or suite of meson test --list')
    parts = [
        t for t in tests
        if (short(t['suite']) & set(a.suite) or t['name'] in a.test) and t['name'] not in a.without
    ]
    return [{'name': t['name'], 'cmd': t['cmd'], 'env': t['env'], 'workdir': t['workdir'], 'depends': t['depends']} for t in parts]


class Campaign:
    def __init__(self, a, scratch, judge, results):
        self.a, self.scratch, self.judge, self.results = a, scratch, judge, results

    def one(self, mutant):
        """Makes one mutant, judges it, and takes it back."""
        path = self.scratch.tree / mutant['file']
        if not path.is_file():
            return self.results.add(mutant, outcome='gone')
        text = path.read_text()
        changed, line = applied(text, mutant)
        if changed is None:
            return self.results.add(mutant, outcome='gone')
        objects = self.scratch.objects.get(mutant['file'], [])
        objects = [o for o in objects if (self.scratch.build / o).exists()]
        if objects:
            self.scratch.ninja(*objects)
        before = self.scratch.compiled(mutant['file'])
        path.write_text(changed)
        try:
            if objects and not self.scratch.ninja(*objects)[0]:
                return self.results.add(mutant, outcome='no compile', now=line)
            if before and before == self.scratch.compiled(mutant['file']):
                return self.results.add(mutant, outcome='same object', now=line)
            if not self.scratch.ninja(*self.judge.targets)[0]:
                return self.results.add(mutant, outcome='no compile', now=line)
            outcome, by, said = self.judge.verdict(mutant.get('name', f'{mutant["file"]}:{line}'))
            return self.results.add(mutant, outcome=outcome, by=by, said=said[-500:], now=line)
        finally:
            path.write_text(text)

    def run(self, mutants, wanted):
        rows = []
        for mutant in mutants:
            if sum(counts(r) for r in rows) >= wanted:
                break
            row = self.results.outcome(mutant) or self.one(mutant)
            rows.append(row)
            if counts(row):
                print(f'{sum(counts(r) for r in rows)}/{wanted} {title(row)}: {row["outcome"]} {row.get("by", "")}', flush=True)
        return rows


def counts(row):
    return row['outcome'] in ('killed', 'timeout', 'lived')


def title(mutant):
    name = mutant.get('name')
    return f'{name} ({mutant["file"]})' if name else f'{mutant["file"]}:{mutant["line"]} {mutant["operator"]}'


def show(mutant):
    print(title(mutant))
    for sign, text in (('-', mutant['old']), ('+', mutant['new'])):
        for line in text.split('\n'):
            print(f'  {sign} {line.strip()}')


def summary(rows, least):
    """Prints what lived, what could not be run, and the score."""
    count = lambda *names: sum(r['outcome'] in names for r in rows)  # noqa: E731
    lived = [r for r in rows if r['outcome'] == 'lived']
    if lived:
        print('\nThese live:')
    for row in lived:
        show(row)
    gone = [r for r in rows if r['outcome'] == 'gone' or not counts(r) and 'name' in r]
    for row in gone:
        print(f'{title(row)}: {"the old text is no longer there" if row["outcome"] == "gone" else row["outcome"]}')
    killed, judged = count('killed', 'timeout'), count('killed', 'timeout', 'lived')
    print(
        f'\n{killed} of {judged} killed ({100 * killed / max(judged, 1):.0f} %), {count("timeout")} of them by their time; '
        f'drawn again: {count("no compile")} that did not compile, {count("same object")} that made no difference'
    )
    return 1 if gone or 100 * killed < least * judged else 0


def main(argv):
    a = arguments(argv)
    mutants, wanted = bugs(a)
    if a.show:
        for mutant, _ in zip(mutants, range(wanted)):
            show(mutant)
        return 0
    scratch = Scratch(a.source, a.scratch, a.setup)
    results = Results(a.results or scratch.place / 'results.jsonl')
    judge = Judge(a, scratch)
    print('healthy: ' + ', '.join(f'{t["name"]} {t["seconds"]:.2f} s' for t in judge.parts), flush=True)
    rows = Campaign(a, scratch, judge, results).run(mutants, wanted)
    print(f'results: {results.path}')
    return summary(rows, a.at_least)


if __name__ == '__main__':
    try:
        sys.exit(main(sys.argv[1:]))
    except Bad as why:
        sys.exit(f'tests/mutants: {why}')
    except KeyboardInterrupt:
        sys.exit('tests/mutants: interrupted; the same command continues')
