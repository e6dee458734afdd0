"""``gbnbench devices`` and ``gbnbench doctor``: this machine's OpenCL devices, and tests of the kernels."""

from __future__ import annotations

import click

from gbnbench.cli import options
from gbnbench.cli.json_text import json_text


@click.command(cls=options.Command)
@options.json
@options.device
def devices(as_json: bool) -> None:
    """List the OpenCL devices; the marked one is used."""
    from gbnbench.opencl import choose
    from gbnbench.opencl import devices as found

    present = found()
    chosen = choose()  # with none present it says what to install
    if as_json:
        rows = [
            {
                "index": device.index,
                "label": device.label,
                "kind": "CPU" if device.is_cpu else "GPU",
                "compute_units": device.compute_units,
                "double": device.has_double,
                "driver": device.driver,
                "used": device == chosen,
            }
            for device in present
        ]
        click.echo(json_text(rows))
        return
    for device in present:
        mark = "*" if device == chosen else " "
        precision = "double" if device.has_double else "float only"
        kind = "CPU" if device.is_cpu else "GPU"
        click.echo(f"{mark} {device.index}  {device.label}")
        click.echo(f"     {kind}, {device.compute_units} compute units, {precision}, driver {device.driver}")


@click.command(cls=options.Command)
@options.quick_or_full("--quick is only what compare checks before it trusts a device.", default="full")
@options.json
@click.option("--quiet", is_flag=True, help="Only the checks that fail, and the verdict.")
@options.device
def doctor(quick: bool, as_json: bool, quiet: bool) -> None:
    """Test every kernel on your device against numpy."""
    from gbnbench.doctor.examination import examine_apart

    examination = examine_apart(quick)
    checks = [check for check in examination.checks if not (quiet and check.passed)]
    if as_json:
        rows = [
            {
                "kernel": check.kernel,
                "precision": check.precision,
                "size": check.size,
                "passed": check.passed,
                "error": check.error,
                "allowed": check.allowed,
                "fault": check.fault,
            }
            for check in checks
        ]
        click.echo(json_text(rows))
    else:
        width = max((len(check.kernel) for check in checks), default=0)
        for check in checks:
            mark = "ok    " if check.passed else "FAILED"
            found = check.fault or f"error {check.error:.1e}, allowed {check.allowed:.1e}"
            click.echo(f"{mark} {check.kernel:<{width}} {check.precision:<6} {check.size}: {found}")
    click.echo(examination.verdict, err=as_json)
    if not examination.trusted:
        click.get_current_context().exit(1)
