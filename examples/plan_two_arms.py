"""Plan two arms past each other, and judge the motion by all bodies, between the steps too."""

from pathlib import Path

from dualarm_repro.planning import METHODS, plan_file, truth

tasks = Path(__file__).parents[1] / "data/scenes/example_tasks.yaml"
for name in ("attraction-only", "apf-improved", "apf-bidirectional"):
    print(f"{name}: {METHODS[name].description}")
    found = plan_file(tasks, name)
    for arm, plan in found.plans.items():
        print(f"  {arm}: {plan.reason} after {plan.steps} steps")
    judged = truth(found.scene, found.paths)
    print(f"  {judged.verdict}: closest bodies are at least {judged.lower:.4f} m apart")
