"""The tab "Taut" of the 3D viewport's sidebar."""

import bpy

from . import operators, options


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Taut"

    def layout_of(self):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        return layout


def _button(layout, settings, operator, icon):
    row = layout.row()
    row.scale_y = 1.3
    options.copy(settings, row.operator(operator.bl_idname, icon=icon), operator)


class TAUT_PT_main(_Panel, bpy.types.Panel):
    bl_label = "Geodesics"

    def draw(self, context):
        layout, settings = self.layout_of(), context.scene.taut
        settings.draw_source(layout)
        settings.draw_method(layout)
        settings.draw_space(layout)
        settings.draw_evaluated(layout)


class TAUT_PT_heat(_Panel, bpy.types.Panel):
    bl_label = "Heat"
    bl_parent_id = "TAUT_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        context.scene.taut.draw_heat(self.layout_of())


class TAUT_PT_distance(_Panel, bpy.types.Panel):
    bl_label = "Distance"

    def draw(self, context):
        layout, settings = self.layout_of(), context.scene.taut
        settings.draw_distance(layout)
        _button(layout, settings, operators.TAUT_OT_distance, "DRIVER_DISTANCE")
        layout.prop(context.space_data.shading, "color_type", text="Viewport")


class TAUT_PT_isolines(_Panel, bpy.types.Panel):
    bl_label = "Isolines"

    def draw(self, context):
        layout, settings = self.layout_of(), context.scene.taut
        settings.draw_isolines(layout)
        settings.draw_thickness(layout)
        _button(layout, settings, operators.TAUT_OT_isolines, "ALIGN_JUSTIFY")


class TAUT_PT_path(_Panel, bpy.types.Panel):
    bl_label = "Shortest Path"

    def draw(self, context):
        layout, settings = self.layout_of(), context.scene.taut
        settings.draw_path(layout)
        settings.draw_thickness(layout)
        _button(layout, settings, operators.TAUT_OT_path, "CURVE_PATH")


class TAUT_PT_voronoi(_Panel, bpy.types.Panel):
    bl_label = "Voronoi Cells"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout_of(), context.scene.taut
        settings.draw_spread(layout)
        _button(layout, settings, operators.TAUT_OT_spread, "STICKY_UVS_DISABLE")
        _button(layout, settings, operators.TAUT_OT_voronoi, "MESH_ICOSPHERE")


classes = TAUT_PT_main, TAUT_PT_heat, TAUT_PT_distance, TAUT_PT_isolines, TAUT_PT_path, TAUT_PT_voronoi
