"""Laws of a model's parameters over the coil current, from one joint fit of a campaign.

`law` stands below the model that carries laws, `fit` above it: import from these two.
"""
