#!/usr/bin/env python3
"""The sabotage script on a toy: what it draws compiles and differs, and its verdicts are right."""

import itertools
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from draw import EXTRA, OPERATORS, draw, every  # noqa: E402
from records import Bad, Results, applied, given  # noqa: E402

TOY = HERE / 'toy'
TEXT = (TOY / 'toy.c').read_text()

LIST = '''# Some bugs of the toy: a list of four.

# sum: the mean of one point less
file: toy.c
-   return sum / (double)(n - 2);
+   return sum / (double)(n - 1);

# silent: what no test looks at
file: toy.c
- a > b && a > 0
+ a > b

# typo: text that does not compile
file: toy.c
- double sum = 0;
+ double sum = ;

# endless: a loop without end
file: toy.c
- double sum = 0;
+ double sum = 0;
+ for (volatile int i = 0; i < 1;)
+   ;
'''


def drawn(operator):
    return every('toy.c', TEXT, (operator,))[operator]


class Drawing(unittest.TestCase):
    def test_every_operator_changes_what_it_names(self):
        wanted = {
            'sign': ('  return a - b;', '  return a + b;'),
            'index': ('weights[1] * x[i] ', 'weights[1] * x[i + 1] '),
            'constant': ('{0.25, 0.5, 0.25}', '{0.25, 0.505, 0.25}'),
            'drop': ('a > b && a > 0 ?', 'a > b  ?'),
            'swap': ('difference(a, b)', 'difference(b, a)'),
            'boundary': ('if (a > 1e6)', 'if (a >= 1e6)'),
        }
        for operator in OPERATORS + EXTRA:
            old, new = wanted[operator]
            made = [m['new'] for m in drawn(operator) if old in m['old']]
            self.assertTrue(any(new in text for text in made), f'{operator}: {made}')

    def test_whole_draws_compile_and_differ(self):
        with tempfile.TemporaryDirectory() as folder:
            text = ''
            for n, m in enumerate(itertools.islice(draw({'toy.c': TEXT}, 3), 400)):
                changed, line = applied(TEXT, m)
                self.assertNotEqual(changed, TEXT)
                self.assertEqual(line, m['line'])
                text = f'{folder}/{n}.c'
                Path(text).write_text(changed)
            done = subprocess.run(
                [*os.environ.get('CC', 'cc').split(), '-std=c11', '-fsyntax-only', *map(str, Path(folder).glob('*.c'))],
                capture_output=True, text=True,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater(n, 60)

    def test_comments_texts_and_descriptors_stay(self):
        kept = [m['old'] for o in OPERATORS + EXTRA for m in drawn(o)]
        for text in ('SCALE 3.5', '// nor', '/* nor', 'preset of', '"%g', 'double pair[3]'):
            self.assertFalse([old for old in kept if text in old], text)

    def test_same_seed_same_mutants(self):
        first, second, other = ([m['new'] for m in draw({'toy.c': TEXT}, seed)] for seed in (7, 7, 8))
        self.assertEqual(first, second)
        self.assertNotEqual(first, other)
        self.assertEqual(sorted(first), sorted(other))


class Placing(unittest.TestCase):
    def test_a_drawn_mutant_is_found_again_when_lines_moved(self):
        for m in drawn('sign'):
            changed, line = applied('\n\n\n' + TEXT, m)
            self.assertEqual((changed.replace('\n\n\n', '', 1), line - 3), applied(TEXT, m))
            self.assertEqual(applied(TEXT + TEXT, m)[1], m['line'], 'of two places the one nearer to its line')

    def test_a_given_bug_needs_a_place_of_its_own(self):
        with self.assertRaisesRegex(Bad, 'stands there'):
            applied(TEXT, {'name': 'twice', 'file': 'toy.c', 'old': 'double', 'new': 'float'})


class Judging(unittest.TestCase):
    def campaign(self, folder, *options):
        results = Path(folder) / 'results'
        done = subprocess.run(
            [sys.executable, HERE, '--source', folder / 'toy', '--scratch', folder / 'scratch', '--results', results]
            + [str(o) for o in options],
            capture_output=True, text=True,
        )
        return done, Results(results).rows.values()

    def test_verdicts(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / 'toy').mkdir()
            for file in TOY.iterdir():
                (folder / 'toy' / file.name).write_bytes(file.read_bytes())
            (folder / 'bugs.txt').write_text(LIST)
            self.assertEqual(len(given(folder / 'bugs.txt')), 4)
            command = ['--list', folder / 'bugs.txt', '--grace', '0', '--run', 'sh -c "$MUTANT_BUILD/mean"']
            done, rows = self.campaign(folder, *command)
            found = {r['name']: r['outcome'] for r in rows}
            self.assertEqual(
                found, {'sum': 'killed', 'silent': 'lived', 'typo': 'no compile', 'endless': 'timeout'}, done.stderr
            )
            self.assertIn('2 of 3 killed (67 %)', done.stdout)
            self.assertEqual((folder / 'toy/toy.c').read_text(), TEXT)
            self.assertEqual((folder / 'scratch/tree/toy.c').read_text(), TEXT)
            # what was judged is not judged again
            again, rows = self.campaign(folder, *command)
            self.assertEqual(again.stdout.splitlines()[-1], done.stdout.splitlines()[-1])
            self.assertEqual((folder / 'results').read_text().count('\n'), 4)


if __name__ == '__main__':
    unittest.main()
