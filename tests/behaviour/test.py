#!/usr/bin/env python3
"""What compares two builds sees a number, a byte and a record that changed, and nothing else. sink.c and clock.c are
compiled on the way.

    test.py BUILD
"""

import contextlib
import io
import json
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))

import scenes  # noqa: E402
from differences import diff  # noqa: E402
from take import Take, flags  # noqa: E402

BUILD = sys.argv.pop()


class Comparing(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        for name in 'ab':
            folder = Path(self.place.name) / name
            (folder / 'numbers').mkdir(parents=True)
            (folder / 'numbers/film').write_text('film.h_min 0x1.8p-22\nfilm.p_max 0x1.0p+30\n')
            (folder / 'help').write_bytes(b'exit 0\n--- stdout\nusage\n')

    def compared(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            code = diff(*(Path(self.place.name) / name for name in 'ab'))
        return code, said.getvalue()

    def change(self, name, old, new):
        path = Path(self.place.name) / 'b' / name
        path.write_bytes(path.read_bytes().replace(old, new))

    def test_equal_records_are_silent(self):
        self.assertEqual(self.compared(), (0, 'values: 1 same, 0 differ, 0 only in one\ntexts: 1 same, 0 differ, 0 only in one\n'))

    def test_a_changed_number_is_shown(self):
        self.change('numbers/film', b'0x1.8p', b'0x1.9p')
        code, said = self.compared()
        self.assertEqual(code, 1)
        self.assertIn('differs: numbers/film\n  -film.h_min 0x1.8p-22\n  +film.h_min 0x1.9p-22\nvalues: 0 same, 1 differ', said)

    def test_a_changed_byte_at_a_line_end_is_seen(self):
        self.change('help', b'usage\n', b'usage')
        code, said = self.compared()
        self.assertEqual(code, 2)
        self.assertIn('values: 1 same, 0 differ, 0 only in one\ntexts: 0 same, 1 differ', said)

    def test_a_lost_record_is_named(self):
        (Path(self.place.name) / 'b/help').unlink()
        code, said = self.compared()
        self.assertEqual(code, 2)
        self.assertIn('/a: help\nvalues: 1 same, 0 differ, 0 only in one\ntexts: 0 same, 0 differ, 1 only', said)


class Taking(unittest.TestCase):
    def test_a_bit_that_no_printed_digit_shows_is_recorded(self):
        with tempfile.TemporaryDirectory() as place:
            take = Take(BUILD, f'{place}/out', ROOT)
            sets = {'a': 'discs.radius=12.8 mm', 'again': 'discs.radius=12.8 mm', 'b': 'discs.radius=12.800000000000004 mm'}
            printed = {}
            for name, text in sets.items():
                take.scene(name, scenes.DISCS, ['film.use=ehl/film-formula', text])
                said = take.run(['run', scenes.DISCS, '--json', *flags(['outputs=discs.hertz_pressure', text])])[1]
                printed[name] = json.loads(said)['outputs']
            taken = {name: (take.out / 'numbers' / name).read_text() for name in sets}
        self.assertRegex(taken['a'], r'^exit 0\n(.*\n)*discs\.time 1 [0-9a-f]{64}\n')
        self.assertIn('discs.reduced_modulus 0x1.', taken['a'])
        self.assertEqual(taken['a'], taken['again'])
        self.assertEqual(printed['a'], printed['b'])
        self.assertNotEqual(taken['a'], taken['b'])

    def test_a_command_is_recorded_with_its_exit_code_and_what_it_writes(self):
        with tempfile.TemporaryDirectory() as place:
            take = Take(BUILD, f'{place}/out', ROOT)
            take.command('schema {file}', file='file.json')
            take.command('check nothing.yaml')
            wrote, failed = (
                (take.out / f'bytes/{name}').read_bytes() for name in ('schema_file.json', 'check_nothing.yaml'))
        self.assertRegex(wrote, rb'exit 0\n--- stdout\n(.*\n)?--- stderr\n--- file.json\n\{')
        self.assertRegex(failed, rb'exit 2\n--- stdout\n--- stderr\n.*nothing.yaml')


if __name__ == '__main__':
    unittest.main()
