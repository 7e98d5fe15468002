"""The creeping snowpack: material law, region, mesh, flow."""
