"""``mre-core schema``."""

import click


@click.command(short_help="Print the JSON schema of settings files.")
def schema() -> None:
    """Print the JSON schema of settings files, for an editor or a check.

    \b
    Example:
      mre-core schema > mre-core.schema.json
    """  # noqa: D301  # \b keeps the lines
    import json

    from .settings_schema import settings_model

    click.echo(json.dumps(settings_model().model_json_schema(), indent=2))
