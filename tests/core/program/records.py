# SPDX-License-Identifier: GPL-3.0-or-later
"""The records of journals, whole: each form is said once in a journal, and filled by the values of a line.

    python3 records.py JOURNAL...    prints them, one a line
"""
import json
import sys


def filled(form, values):
    if isinstance(form, dict):
        return {key: filled(item, values) for key, item in form.items()}
    if isinstance(form, list):
        return [filled(item, values) for item in form]
    return next(values) if form is None else form


def read(path):
    forms, records = {}, []
    with open(path, encoding="utf-8") as file:
        for line in map(json.loads, file):
            name = line.pop("form", None)
            if name is not None:
                forms.setdefault(name, line.pop("is", None))
                values = iter(line.pop("values"))
                line.update(filled(forms[name], values))
                assert next(values, None) is None, "a value is left over"
            records.append(line)
    return records


if __name__ == "__main__":
    for journal in sys.argv[1:]:
        for record in read(journal):
            print(json.dumps(record, separators=(",", ":"), ensure_ascii=False))
