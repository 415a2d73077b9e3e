"""What a notebook shows: the profile of a tool as SVG, results and parts as tables."""

import html

import numpy as np

from . import _core


def _outline(tool):
    """Half profile from the tip's lowest point to the upper end, N x 2: z, radius."""
    flank = np.asarray(tool.meridian(201))
    # Below the flank's first point its inscribed sphere rounds the tip off.
    z0, rho0 = flank[0]
    lowest = -float(tool.radius(np.array([0.0]))[0])
    around = np.linspace(0.0, 1.0, 33)[:-1]
    first = np.arctan2(rho0, z0)
    angles = np.pi + (first - np.pi) * around
    tip = -lowest * np.column_stack([np.cos(angles), np.sin(angles)])
    return np.vstack([tip, flank] + [np.asarray(part) for part in (tool.shank, tool.holder) if len(part)])


def tool_svg(tool):
    """Both sides of the profile to scale, the tip at the left; the view box is in millimetres."""
    half = _outline(tool)
    z, r = half[:, 0], half[:, 1]
    margin = 0.05 * max(np.ptp(z), 2 * r.max())
    box = (z.min() - margin, -r.max() - margin, np.ptp(z) + 2 * margin, 2 * (r.max() + margin))
    points = " ".join(f"{a:.4f},{b:.4f}" for a, b in np.vstack([half, (half * [1, -1])[::-1]]))
    line = box[2] / 400
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box[0]:.4f} {box[1]:.4f} {box[2]:.4f} {box[3]:.4f}" width="480">'
            f"<title>{html.escape(tool.name)}</title>"
            f'<polygon points="{points}" fill="#b8c4d0" stroke="#334" stroke-width="{line:.4f}"/>'
            f'<line x1="{box[0]:.4f}" y1="0" x2="{box[0] + box[2]:.4f}" y2="0" stroke="#334" stroke-width="{line:.4f}" '
            f'stroke-dasharray="{8 * line:.4f} {3 * line:.4f} {line:.4f} {3 * line:.4f}"/></svg>')


def _row(values, tag):
    return "<tr>" + "".join(f"<{tag}>{html.escape(str(value))}</{tag}>" for value in values) + "</tr>"


def _table(rows, header):
    body = "".join(_row(row, "td") for row in rows)
    return f"<table><thead>{_row(header, 'th')}</thead><tbody>{body}</tbody></table>"


def part_html(part):
    """A table of the faces."""
    return _table([(face.id, face.type, face.trims, face.left_out) for face in part.faces], ("face", "type", "trims", "not read"))


def report_html(report):
    """A table of the verdict, face by face."""
    rows = [(face.face, "target" if face.target else "check", f"{100 * face.coverage:.2f} %" if face.target else "",
             f"{face.overcut_mm:.4f}", f"{face.overcut_bound_mm:.4f}", f"{face.undercut_mm:.4f}" if face.target else "")
            for face in report.faces]
    header = ("face", "", "finished", "gouge, mm", "proved, mm", "excess material, mm")
    return f"<p>{html.escape(report.verdict)} at {report.tolerance_mm:g} mm</p>" + _table(rows, header)


def result_html(result):
    """The summary and the tool's profile."""
    return f"<pre>{html.escape(result.text)}</pre>{tool_svg(result.tool)}"


def add_to_classes():
    _core.Tool._repr_svg_ = tool_svg
    _core.Part._repr_html_ = part_html
    _core.VerifyReport._repr_html_ = report_html
    _core.Result._repr_html_ = result_html
