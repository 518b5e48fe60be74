"""Lists of given bugs, and the results of a campaign: one JSON object per line."""

import json
import re
from pathlib import Path


class Bad(Exception):
    """Something that the user can mend."""


def given(path):
    """The bugs of a list: blocks of `# name: what it breaks` (the name is one word), `file: PATH`, `- old` and `+ new` lines."""
    bugs, bug = [], None
    for number, line in enumerate(Path(path).read_text().split('\n'), 1):
        title = re.match(r'# ([\w.-]+): (.*)', line)
        if title:
            bug = {'name': title[1], 'what': title[2], 'file': None, 'old': None, 'new': None}
            bugs.append(bug)
        elif line.startswith('#') or not line.strip():
            continue
        elif bug is not None and line.startswith('file:'):
            bug['file'] = line[5:].strip()
        elif bug is not None and line[:2] in ('- ', '-', '+ ', '+'):
            key = 'old' if line[0] == '-' else 'new'
            bug[key] = line[2:] if bug[key] is None else bug[key] + '\n' + line[2:]
        else:
            raise Bad(f'{path}:{number}: expected "# name: what it breaks", "file: PATH", "- old" or "+ new"')
    for bug in bugs:
        if not bug['file'] or bug['old'] is None:
            raise Bad(f'{path}: bug "{bug["name"]}" needs a line "file: PATH" and lines "- old text"')
        bug['new'] = bug['new'] or ''
        bug['operator'] = 'given'
    return bugs


def place(text, mutant):
    """Where the old text of a mutant stands in `text`; of several places the one nearest to its line."""
    at, found = text.find(mutant['old']), []
    while at >= 0:
        found.append(at)
        at = text.find(mutant['old'], at + 1)
    if 'line' not in mutant and len(found) > 1:
        raise Bad(f'{mutant["file"]}: the old text of "{mutant["name"]}" stands there {len(found)} times')
    if not found:
        return None
    return min(found, key=lambda a: abs(text.count('\n', 0, a) + 1 - mutant.get('line', 0)))


def applied(text, mutant):
    """The text with the mutant in it and the line where; (None, 0) if its old text is gone."""
    at = place(text, mutant)
    if at is None:
        return None, 0
    return text[:at] + mutant['new'] + text[at + len(mutant['old']) :], text.count('\n', 0, at) + 1


def key(mutant):
    return mutant['file'], mutant['old'], mutant['new'], mutant.get('line', 0) if 'name' not in mutant else 0


class Results:
    """Outcomes by mutant; each is on disk before the next begins."""

    def __init__(self, path):
        self.path = path
        self.rows = {}
        try:
            for line in Path(path).read_text().splitlines():
                row = json.loads(line)
                self.rows[key(row)] = row
        except FileNotFoundError:
            pass
        except (ValueError, KeyError):
            raise Bad(f'{path}: expected results of an earlier campaign, one JSON object per line') from None

    def outcome(self, mutant):
        return self.rows.get(key(mutant))

    def add(self, mutant, **what):
        row = {**mutant, **what}
        self.rows[key(mutant)] = row
        with open(self.path, 'a') as out:
            out.write(json.dumps(row) + '\n')
        return row
