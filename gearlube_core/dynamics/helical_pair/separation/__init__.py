"""The pair with flanks that separate: periodic motions at prescribed speed."""
