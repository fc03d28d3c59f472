"""Add a planner: an entry of METHODS, which `plan_file` then takes like any other."""

from dataclasses import replace
from pathlib import Path

from dualarm_repro.planning import METHODS, certified_clearance, plan_file, plan_master_slave, truth


def careful(given, tasks):
    """Let the obstacles repel from farther and farther away, until whole links are certified."""
    for factor in (1.0, 2.0, 4.0, 8.0):
        wider = {}
        for arm, task in tasks.items():
            repulsion = task.settings.repulsion
            repulsion = repulsion.changed(influence=factor * repulsion.influence)
            wider[arm] = replace(task, settings=task.settings.changed(repulsion=repulsion))
        found = plan_master_slave(given.scene, wider, leave_out=given.leave_out)
        if certified_clearance(found.scene, found.paths).lower > 0.0:
            break
    return found


name, about = "apf-careful", "the improved field, its range widened until whole links keep clear"
METHODS[name] = replace(METHODS["apf-improved"], name=name, description=about, plan=careful)

tasks = Path(__file__).parents[1] / "data/scenes/example_tasks.yaml"
for name in ("apf-improved", "apf-careful"):
    found = plan_file(tasks, name)
    print(f"{name}: {METHODS[name].description}")
    print(f"  arrived: {[bool(plan.reached) for plan in found.plans.values()]}")
    judged = truth(found.scene, found.paths)
    print(f"  {judged.verdict}: at least {judged.lower:.4f} m apart, {len(found.index)} steps")
