"""Runs an operator's work on a thread of its own, so that the window stays alive, with progress and Esc to cancel.

An operator derives from `Operation` and says two things: `prepare` reads Blender's data and returns a function of a
`work.Watch` that works on numpy arrays alone; `finish` writes what that returns. Called from a script (EXEC_DEFAULT) or without
a window they run one after the other. From a button the function runs on a thread, and the user may go on working: a mesh that
has changed when it is done is left alone.
"""

import threading

import bpy

from . import results, surface, taut, work

_SECONDS = 0.05
_BAR = 20


class Job:
    """A function of a `work.Watch` that runs on a thread."""

    def __init__(self, compute):
        self.watch = work.Watch(taut.Control())
        self._result = self._error = None
        self._thread = threading.Thread(target=self._run, args=(compute,), daemon=True)
        self._thread.start()

    def _run(self, compute):
        try:
            self._result = compute(self.watch)
        except Exception as error:  # outcome() raises it
            self._error = error

    @property
    def is_done(self):
        return not self._thread.is_alive()

    def cancel(self):
        self.watch.control.cancel()

    def wait(self):
        self._thread.join()

    def outcome(self):
        """Waits for the end. What the function returned, or raises what it raised; a cancelled one has no result."""
        self.wait()
        if self._error is not None:
            raise self._error
        if self.watch.control.is_cancelled:
            raise taut.Cancelled("cancelled")
        return self._result

    def __str__(self):
        share = self.watch.control.progress
        full = round(share * _BAR)
        return f"{self.watch.stage}  {'█' * full}{'░' * (_BAR - full)}  {share:4.0%}"


_running = None


def stop():
    """Cancels the job that runs, if any, and waits for its end."""
    global _running
    if _running is not None:
        _running.cancel()
        _running.wait()
        _running = None


class Operation:
    """What all operators share. A mesh must be active, in object mode or edit mode; the mode stays as it is."""

    bl_options = {"REGISTER", "UNDO"}
    evaluated = False
    places = surface.Places()

    def prepare(self, context, target):
        """Reads what is needed of `target`, besides `self.surface`; returns what is to be computed."""
        raise NotImplementedError

    def finish(self, context, target, result):
        """Writes the result, in object mode."""
        raise NotImplementedError

    def check(self, mesh):
        """Refuses a mesh that the values cannot be written to."""
        raise NotImplementedError

    def written_to(self, context, target):
        """The object that values go to: a new one where modifiers make other vertices."""
        if not self.surface.is_object:
            return results.copy_of_evaluated(context, target, self.check)
        self.check(target.data)
        return target

    @classmethod
    def poll(cls, context):
        target = context.active_object
        return target is not None and target.type == "MESH" and target.mode in {"OBJECT", "EDIT"}

    def execute(self, context):
        try:
            return self._write(context, context.active_object, self._read(context)(work.Watch(taut.Control())))
        except (surface.Problem, taut.Error) as error:
            return self._refused(error)

    def invoke(self, context, event):
        global _running
        if context.window is None:
            return self.execute(context)
        if _running is not None:
            self.report({"ERROR"}, "Taut is still at work; Esc cancels it")
            return {"CANCELLED"}
        try:
            self._job = _running = Job(self._read(context))
        except (surface.Problem, taut.Error) as error:
            return self._refused(error)
        context.window_manager.progress_begin(0, 1000)
        self._timer = context.window_manager.event_timer_add(_SECONDS, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self._job.cancel()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if not self._job.is_done:
            self._show(context)
            return {"PASS_THROUGH"}
        self._end(context)
        try:
            result = self._job.outcome()
            return self._write(context, self._unchanged(), result)
        except (surface.Problem, taut.Error) as error:
            return self._refused(error)

    def cancel(self, context):
        """Blender ends the operator: another file is loaded, or the window closes."""
        stop()
        self._end(context)

    def _read(self, context):
        target = context.active_object
        self._name = target.name
        self.surface = surface.read(target, self.evaluated)
        return self.prepare(context, target)

    def _unchanged(self):
        target = bpy.data.objects.get(self._name)
        if target is None or target.type != "MESH":
            raise surface.Problem(f"{self._name} is gone; nothing was written")
        if target.mode not in {"OBJECT", "EDIT"} or not surface.read(target, self.evaluated).same_as(self.surface):
            raise surface.Problem(f"{self._name} has changed meanwhile; nothing was written")
        return target

    def _write(self, context, target, result):
        with surface.object_mode(target):
            self.finish(context, target, result)
        return {"FINISHED"}

    def _refused(self, error):
        if isinstance(error, taut.Cancelled):
            self.report({"WARNING"}, "Cancelled; nothing was written")
        else:
            is_own = isinstance(error, surface.Problem)
            self.report({"ERROR"}, str(error) if is_own else work.explained(error, self.surface, self.places))
        return {"CANCELLED"}

    def _show(self, context):
        context.window_manager.progress_update(int(1000 * self._job.watch.control.progress))
        context.workspace.status_text_set(f"{self._job}    Esc: cancel")
        if context.area is not None:
            context.area.header_text_set(f"{self.bl_label}: {self._job}")

    def _end(self, context):
        global _running
        _running = None
        manager = context.window_manager
        manager.progress_end()
        manager.event_timer_remove(self._timer)
        for workspace in bpy.data.workspaces:
            workspace.status_text_set(None)
        if context.area is not None:
            context.area.header_text_set(None)
