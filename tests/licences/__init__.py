"""What others' work the package is made of, under which licences."""
