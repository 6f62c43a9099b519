"""The pair with flanks that stay in contact: periodic response and stability."""
