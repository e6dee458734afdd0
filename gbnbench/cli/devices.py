"""``gbnbench devices`` and ``gbnbench doctor``: what this machine computes with, and whether to trust it."""

from __future__ import annotations

import click

from gbnbench.cli import options


@click.command()
@options.device
def devices() -> None:
    """List the OpenCL devices; the marked one is used."""
    from gbnbench.opencl import choose
    from gbnbench.opencl import devices as found

    present = found()
    chosen = choose()  # with none present it says what to install
    for device in present:
        mark = "*" if device == chosen else " "
        precision = "double" if device.has_double else "float only"
        kind = "CPU" if device.is_cpu else "GPU"
        click.echo(f"{mark} {device.index}  {device.label}")
        click.echo(f"     {kind}, {device.compute_units} compute units, {precision}, driver {device.driver}")


@click.command()
@click.option("--quick", is_flag=True, help="Only what compare checks before it trusts a device.")
@options.device
def doctor(quick: bool) -> None:
    """Test every kernel against plain numpy on your device, and say whether to trust it."""
    from gbnbench.doctor.kernel_checks import examine

    examination = examine(quick=quick)
    width = max(len(check.kernel) for check in examination.checks)
    for check in examination.checks:
        mark = "ok    " if check.passed else "FAILED"
        found = check.fault or f"error {check.error:.1e}, allowed {check.allowed:.1e}"
        click.echo(f"{mark} {check.kernel:<{width}} {check.precision:<6} {check.size}: {found}")
    click.echo(examination.verdict)
    if not examination.trusted:
        click.get_current_context().exit(1)
