"""Files for renderers: arrays of points and dither masks as C headers, plain binary, JSON, PNG and EXR."""
