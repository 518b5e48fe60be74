#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names pages of measurements whose sources have other code than when they were made.

stale.py SOURCE_ROOT

A page ends with `<!-- made at COMMIT from PATH... -->` (docs/made.sh writes it). Code is compared without comments
and blanks, so that a plainer comment makes no page stale. Stale pages are listed; the check fails where one is more
than OLDEST days older than the last commit, or where a line names no commit or no path of it. Without a
repository, or in one whose history does not reach back, it is skipped."""
import pathlib
import re
import subprocess
import sys

OLDEST = 30  # days
SKIPPED = 77
LINE = re.compile(r'^<!-- made at (\S+) from (.+) -->$', re.M)
TOKENS = re.compile(rb'^#include[^\n]*|//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\')', re.S | re.M)


def code_of(text):
    """Source text without comments, blanks and included files, whose places may change."""
    return re.sub(rb'\s+', b'', TOKENS.sub(lambda found: found[1] or b'', text))


class Repository:
    def __init__(self, root):
        self.root, self.codes = root, {}
        self.reader = subprocess.Popen(['git', '-C', root, 'cat-file', '--batch'], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                       stderr=subprocess.DEVNULL)

    def git(self, *words):
        return subprocess.run(['git', '-C', self.root, *words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)

    def day(self, commit):
        """Of a commit; None without one."""
        done = self.git('log', '-1', '--format=%ct', commit, '--')
        return int(done.stdout) / 86400 if done.returncode == 0 and done.stdout else None

    def code(self, commit, path):
        """Of a file at a commit; b'' where it is not there."""
        if (commit, path) not in self.codes:
            self.reader.stdin.write(f'{commit}:{path}\n'.encode())
            self.reader.stdin.flush()
            head = self.reader.stdout.readline().split()
            self.codes[commit, path] = b''
            if head[-1] != b'missing':
                self.codes[commit, path] = code_of(self.reader.stdout.read(int(head[2]) + 1))
        return self.codes[commit, path]

    def other(self, commit, paths):
        """Sources whose code is not that of a file at the commit, of this name or another."""
        names = self.git('diff', '--name-only', '--no-renames', commit, 'HEAD', '--', *paths).stdout.decode().split()
        names = [name for name in names if name.endswith(('.c', '.h'))]
        old = {self.code(commit, name) for name in names}
        return [name for name in names if self.code('HEAD', name) not in old | {b''}]


def look_at(page, text, repository):
    """The sentence on a page, and whether it is a fault."""
    made = LINE.search(text)
    commit, paths = made[1], made[2].split()
    day, now = repository.day(commit), repository.day('HEAD')
    if day is None:
        return f'{page}: there is no commit {commit}', True
    for path in paths:
        if repository.git('cat-file', '-e', f'HEAD:{path}').returncode:
            return f'{page}: there is no {path}', True
    other = repository.other(commit, paths)
    old = now - day > OLDEST and bool(other)
    return f'{page}: made {now - day:.0f} days ago at {commit}; of its sources {len(other)} have other code' if other else '', old


def main():
    root = pathlib.Path(sys.argv[1])
    repository = Repository(str(root))
    if repository.day('HEAD') is None or repository.git('rev-parse', '--is-shallow-repository').stdout.strip() != b'false':
        sys.exit(SKIPPED)
    pages = [(path.relative_to(root), path.read_text(encoding='utf-8')) for path in sorted((root / 'docs').rglob('*.md'))]
    found = [look_at(page, text, repository) for page, text in pages if LINE.search(text)]
    print(*(sentence for sentence, _ in found if sentence), sep='\n')
    print(f'{len(found)} pages say at which commit they were made')
    sys.exit(not found or any(fault for _, fault in found))


if __name__ == '__main__':
    main()
