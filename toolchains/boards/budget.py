"""The budget (budget.csv): limits for the instructions and spills of each shader on each GPU."""
import csv

COLUMNS = ('gpu', 'shader', 'instructions', 'spills', 'fills', 'scratch')
ROOM = 1.05


def row_of(gpu, shader):
    return {'gpu': gpu, 'shader': shader.key, 'instructions': shader.instructions, 'spills': shader.spills,
            'fills': shader.fills, 'scratch': shader.scratch}


def read(path):
    """Returns the rows of a budget file: {(gpu, shader): row}."""
    with open(path, newline='', encoding='utf-8') as file:
        return {(row['gpu'], row['shader']): {k: v if k in COLUMNS[:2] else int(v) for k, v in row.items()}
                for row in csv.DictReader(file)}


def write(path, rows):
    with open(path, 'w', newline='', encoding='utf-8') as file:
        out = csv.DictWriter(file, COLUMNS, lineterminator='\n')
        out.writeheader()
        out.writerows(sorted(rows, key=lambda row: (row['gpu'], row['shader'])))


def faults(rows, budget):
    """Returns a message for each row that exceeds its limits, or has no limits or no statistics."""
    out = []
    for row in rows:
        name = f'{row["shader"]} on {row["gpu"]}'
        if row['instructions'] == 0:
            out.append(f'{name}: its driver printed no statistics')
            continue
        may = budget.get((row['gpu'], row['shader']))
        if may is None:
            out.append(f'{name}: has no budget in budget.csv')
            continue
        if row['instructions'] > ROOM * may['instructions']:
            out.append(f'{name}: {row["instructions"]} instructions, the budget is {may["instructions"]}')
        for what in ('spills', 'fills', 'scratch'):
            if row[what] > may[what]:
                out.append(f'{name}: {row[what]} {what}, the budget is {may[what]}')
    return out
