"""The properties of the operators, in groups that several of them share, and how the panel shows them.

The scene has all of them once more, as what the panel is set to.
"""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from . import taut, work


def _choice(layout, properties, name):
    """Words side by side over the whole width, their title above."""
    column = layout.column(align=True)
    column.use_property_split = False
    column.label(text=properties.bl_rna.properties[name].name)
    column.row(align=True).prop(properties, name, expand=True)


class Evaluated:
    evaluated: BoolProperty(
        name="Modifiers",
        description="Work on the mesh as modifiers and shape keys make it. Where that has other vertices than the object, "
        "values go to a new object",
    )

    def draw_evaluated(self, layout):
        layout.prop(self, "evaluated")


class Space:
    space: EnumProperty(
        name="Lengths",
        description="Where lengths are measured",
        items=[
            ("WORLD", "World", "As seen, with the object's scale"),
            ("LOCAL", "Local", "In the object's own units, without its scale"),
        ],
    )

    def draw_space(self, layout):
        layout.row().prop(self, "space", expand=True)


class Source:
    source: EnumProperty(
        name="From",
        description="Where distances are measured from",
        items=[
            ("VERTICES", "Vertices", "The selected vertices"),
            ("FACES", "Faces", "The centres of the selected faces"),
            ("CURSOR", "Cursor", "The place on the surface nearest to the 3D cursor"),
        ],
    )

    def draw_source(self, layout):
        _choice(layout, self, "source")


class Solver:
    method: EnumProperty(
        name="Method",
        items=[
            ("HEAT", "Heat", "Approximate within one or two percent, and smooth"),
            ("EXACT", "Exact", "The shortest way over the flat triangles"),
        ],
    )
    time_step: EnumProperty(
        name="Time step",
        description="The time for which heat flows, from the edge lengths: their mean e and standard deviation s",
        items=[
            ("MEAN_EDGE", "e²", "The square of the mean edge length"),
            ("SIGMA", "s", "The standard deviation"),
            ("MEAN_SIGMA", "(e² + s) / 2", "The mean of both"),
            ("MEDIAN_FIT", "1.01204 s − 0.0001", "A line fitted to the least median error"),
            ("MEDIAN_MEAN", "(e² + line) / 2", "The mean of that and the square of the mean edge length"),
            ("VALUE", "Value", "A number of your own"),
        ],
    )
    scale: EnumProperty(
        name="Size",
        description="The size that the formula is evaluated at, which matters because all but e² set an area to lengths",
        items=[
            ("PAPER", "Paper", "That for which the formulas were found: a bounding box with the diagonal 24.976"),
            ("RAW", "As it is", "The mesh's own"),
        ],
    )
    factor: FloatProperty(name="Factor", description="Multiplies the formula", default=1, min=1e-6, soft_max=100)
    value: FloatProperty(
        name="Value", description="The time step, in units of length squared", default=1, min=0, precision=6
    )
    boundary: FloatProperty(
        name="Boundary",
        description="Heat at the mesh's boundary: 0 does not flow across, 1 is kept at zero",
        min=0,
        max=1,
    )
    laplacian: EnumProperty(
        name="Laplacian",
        items=[
            ("INTRINSIC", "Intrinsic", "On better triangles of the same surface"),
            ("PLAIN", "Plain", "On the triangles as they are"),
        ],
    )

    def solver(self):
        """As plain data, for other threads."""
        if self.time_step == "VALUE":
            step = taut.TimeStep.value(self.value)
        else:
            step = taut.TimeStep(self.time_step.lower(), self.scale.lower(), self.factor)
        return work.Solver(self.method, step, self.boundary, self.laplacian.lower())

    def draw_method(self, layout):
        layout.row().prop(self, "method", expand=True)

    def draw_heat(self, layout):
        layout.active = self.method == "HEAT"
        layout.prop(self, "time_step")
        if self.time_step == "VALUE":
            layout.prop(self, "value")
        else:
            layout.prop(self, "scale")
            layout.prop(self, "factor")
        layout.prop(self, "boundary", slider=True)
        layout.prop(self, "laplacian")


class Distance:
    attribute_name: StringProperty(
        name="Name",
        description="Of the attribute; the group, the colours and the material are called after it",
        default="geodesic_distance",
    )
    normalize: BoolProperty(name="From 0 to 1", description="Divide distances by the largest one")
    attribute: BoolProperty(name="Attribute", description="Distances at the vertices; inf where none leads", default=True)
    group: BoolProperty(name="Vertex group", description="Weights: 1 at the sources, 0 at the farthest vertex")
    colours: BoolProperty(name="Colours", description="A colour attribute", default=True)
    material: BoolProperty(name="Material", description="A material with a ramp that reads the attribute, on all faces")

    def draw_distance(self, layout):
        layout.prop(self, "attribute_name")
        column = layout.column(heading="Write")
        for name in ("attribute", "group", "colours", "material"):
            column.prop(self, name)
        layout.prop(self, "normalize")


class Isolines:
    values: StringProperty(
        name="Of", description="The attribute of which lines are drawn: numbers at the vertices", default="geodesic_distance"
    )
    levels: EnumProperty(
        name="Levels",
        items=[
            ("COUNT", "Count", "So many, evenly between the least and the greatest value"),
            ("SPACING", "Spacing", "At all multiples of a number"),
        ],
    )
    count: IntProperty(name="Count", description="How many levels", default=20, min=1, max=10000)
    spacing: FloatProperty(name="Spacing", description="In units of the attribute", default=0.1, min=0, precision=4)

    def draw_isolines(self, layout):
        layout.prop(self, "values")
        layout.row().prop(self, "levels", expand=True)
        layout.prop(self, "count" if self.levels == "COUNT" else "spacing")


class Thickness:
    thickness: FloatProperty(
        name="Thickness",
        description="Radius of the curves, in the object's units, so that they can be rendered; 0 for bare lines",
        min=0,
        precision=4,
        unit="LENGTH",
    )

    def draw_thickness(self, layout):
        layout.prop(self, "thickness")


class Path:
    start: EnumProperty(
        name="Start",
        items=[
            ("VERTICES", "Selected", "Through the selected vertices, in the order of selection where Blender has it, "
             "else always on to the nearest one"),
            ("CURSOR", "Cursor", "From the place nearest to the 3D cursor to the selected vertices"),
        ],
    )

    def draw_path(self, layout):
        _choice(layout, self, "start")


class Spread:
    points: IntProperty(name="Points", description="How many vertices are selected in the end", default=12, min=1)

    def draw_spread(self, layout):
        layout.prop(self, "points")


GROUPS = Evaluated, Space, Source, Solver, Distance, Isolines, Thickness, Path, Spread


class Settings(*GROUPS, bpy.types.PropertyGroup):
    """What the panel is set to."""


def copy(settings, properties, cls):
    """Sets the properties of an operator of class `cls` to those of the panel."""
    for group in GROUPS:
        if issubclass(cls, group):
            for name in group.__annotations__:
                setattr(properties, name, getattr(settings, name))
