"""Line contacts: steady, transient and thermal films."""
