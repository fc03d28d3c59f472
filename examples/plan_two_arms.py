"""Plan two arms past each other, and judge the plan by whole links, between the steps too."""

from pathlib import Path

from dualarm_repro.planning import METHODS, certified_clearance, plan_file

tasks = Path(__file__).parents[1] / "data/scenes/example_tasks.yaml"
for name in ("attraction-only", "apf-improved", "apf-bidirectional"):
    print(f"{name}: {METHODS[name].description}")
    found = plan_file(tasks, name)
    for arm, plan in found.plans.items():
        print(f"  {arm}: {plan.reason} after {plan.steps} steps")
    bounds = certified_clearance(found.scene, found.paths)
    print(f"  closest bodies are at least {bounds.lower:.4f} m apart")
