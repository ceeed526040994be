"""Fuzz targets for the layers without I/O: definitions, codecs, headers, frames, XML-RPC."""
