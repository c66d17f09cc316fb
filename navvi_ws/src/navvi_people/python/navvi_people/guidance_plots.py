"""Plots of a batch of trials, as SVG: a mark with its 95 % interval for each person and condition, a panel a measure."""
import statistics

from .guidance_tables import MEASURES, changed_conditions, differences, interval, of, ordered, values

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00")  # Okabe and Ito: told apart by all
LABELS, PANEL, ROW, TOP = 150, 250, 22, 50  # px


def means(rows, conditions):
    """Labels, and for each measure the figures of each label and person."""
    def cell(person, condition, name):
        numbers = values(of(rows, person, condition), name)
        return interval(numbers, statistics.fmean) if numbers else None
    return panels(rows, conditions, cell)


def changes(rows):
    """Likewise, of the differences beside the condition "default"."""
    return panels(rows, changed_conditions(rows), lambda person, condition, name: interval(differences(rows, person, condition, name)))


def panels(rows, conditions, cell):
    people = ordered(rows, "person")
    return people, conditions, {text: [[cell(person, condition, name) for person in people] for condition in conditions]
                                for name, text in MEASURES.items()}


def drawn(title, data):
    """\\param data  of means() or changes(). The same data give the same bytes."""
    people, conditions, measures = data
    band = ROW * (len(people) + 1)
    height, width = TOP + band * len(conditions) + 40, LABELS + PANEL * len(measures) + 20
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" font-size="14">',
           f"<title>{title}</title>", '<rect width="100%" height="100%" fill="white"/>']
    for at, person in enumerate(people):
        out.append(f'<circle cx="{LABELS + 130 * at}" cy="14" r="5" fill="{COLOURS[at]}"/><text x="{LABELS + 130 * at + 10}" y="19">{person}</text>')
    for at, condition in enumerate(conditions):
        out.append(f'<text x="{LABELS - 10}" y="{TOP + band * at + band / 2 + 5:.0f}" text-anchor="end">{condition}</text>')
    for at, (text, cells) in enumerate(measures.items()):
        out += panel(LABELS + PANEL * at, text, cells, band)
    return "\n".join([*out, "</svg>"]) + "\n"


def panel(left, text, cells, band):
    known = [bound for row in cells for cell in row if cell for bound in cell]
    low, high = min(known, default=0.0), max(known, default=1.0)
    low, high = (min(low, 0.0), max(high, 0.0)) if low < 0.0 or low < 0.5 * high else (low, high)
    space = 0.05 * (high - low) or 1.0
    low, high = low - space, high + space

    def place(value):
        return left + 10 + (PANEL - 30) * (value - low) / (high - low)
    bottom = TOP + band * len(cells)
    out = [f'<text x="{left + 10}" y="{TOP - 8}" font-weight="bold">{text}</text>',
           f'<rect x="{left + 10}" y="{TOP}" width="{PANEL - 30}" height="{bottom - TOP}" fill="none" stroke="#808080"/>']
    if low < 0.0 < high:
        out.append(f'<path d="M{place(0.0):.1f},{TOP} V{bottom}" stroke="#808080" stroke-dasharray="4,3"/>')
    for value in (low + space, high - space):
        anchor = "start" if value < (low + high) / 2 else "end"
        out.append(f'<text x="{place(value):.1f}" y="{bottom + 18}" text-anchor="{anchor}">{value:.3g}</text>')
    for row, figures in enumerate(cells):
        for person, cell in enumerate(figures):
            if not cell:
                continue
            y = TOP + band * row + ROW * (person + 1)
            out.append(f'<path d="M{place(cell[1]):.1f},{y} H{place(cell[2]):.1f}" stroke="{COLOURS[person]}" stroke-width="3"/>'
                       f'<circle cx="{place(cell[0]):.1f}" cy="{y}" r="5" fill="{COLOURS[person]}"/>')
    return out
